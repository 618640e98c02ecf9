//! A window that shows scenes: `cargo run --release -p asunder-viewer -- --scene washer`.
//!
//! Shows what the engine finds while a game steps: boxes, candidate pairs, contacts, normals, which tier of precision
//! decided each contact, and what each stage costs. Bodies can be picked up and thrown. `--shot FILE.png --frame 120`
//! writes a picture after so many steps and exits; a virtual display is enough: `xvfb-run -a`.
//!
//! Exit codes: 2 for wrong options, scenes or files, 3 where no window can be opened.

mod batch;
mod form;
mod paint;
mod panel;
mod player;
mod sight;
mod stand;
mod toggles;
mod view;
mod window;

use crate::toggles::{Layer, Toggles};
use crate::window::{Shot, Window, check};
use asunder_examples::game::share_work;
use asunder_scenes::stages::Stage;
use clap::Parser;
use macroquad::conf::Conf;
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind, set_hook, take_hook};
use std::path::PathBuf;
use std::process::ExitCode;
use std::rc::Rc;

/// Shows a scene that steps, and what the asunder collision engine finds in it.
#[derive(Parser)]
#[command(name = "viewer")]
struct Options {
    /// The scene: a name that --list knows, or a scene file, in 2D or 3D
    #[arg(long, value_name = "NAME|FILE.json", default_value = "washer")]
    scene: String,
    /// How many bodies a named scene has, up to 2,000,000: its usual number at first
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=2_000_000))]
    bodies: Option<u32>,
    /// Names the scenes, and their usual numbers of bodies
    #[arg(long)]
    list: bool,
    /// Layers to turn on, or off where they are on at first
    #[arg(long, value_name = "LAYER,..", value_delimiter = ',')]
    flip: Vec<Layer>,
    /// Writes a picture and leaves
    #[arg(long, value_name = "FILE.png")]
    shot: Option<PathBuf>,
    /// After how many steps of 1/60 s the picture is made
    #[arg(long, value_name = "N", default_value_t = 120, requires = "shot")]
    frame: u32,
}

fn main() -> ExitCode {
    let options = Options::parse();
    if options.list {
        for stage in Stage::ALL {
            println!("{:<18} {:>9}  {}", stage.name(), stage.usual_size(), stage.about());
        }
        return ExitCode::SUCCESS;
    }
    share_work();
    let size = options.bodies.map(|bodies| bodies as usize);
    let window = match Window::open(&options.scene, size, Toggles::flipped(&options.flip)) {
        Ok(window) => window,
        Err(error) => return fail(2, &error.to_string()),
    };
    let shot = options.shot.map(|file| (file, options.frame));
    if let Some(Err(error)) = shot.as_ref().map(|(file, _)| check(file)) {
        return fail(2, &error);
    }
    run(window, shot)
}

/// Opens the window; where none can be opened, macroquad panics.
fn run(window: Window, shot: Option<Shot>) -> ExitCode {
    let outcome = Rc::new(RefCell::new(None));
    let told = Rc::clone(&outcome);
    let future = async move {
        // From here on a panic is a fault of this program, and reports where.
        drop(take_hook());
        let result = match shot {
            Some((file, steps)) => window.shoot(&file, steps).await,
            None => {
                window.watch().await;
                Ok(())
            }
        };
        *told.borrow_mut() = Some(result);
    };
    set_hook(Box::new(|_| {}));
    let opened = catch_unwind(AssertUnwindSafe(|| macroquad::Window::from_config(conf(), future)));
    drop(take_hook());
    match (opened, outcome.take()) {
        (Ok(()), Some(Err(error))) => fail(2, &error),
        (Ok(()), _) => ExitCode::SUCCESS,
        (Err(cause), _) => {
            let text =
                cause.downcast_ref::<&str>().copied().or(cause.downcast_ref::<String>().map(String::as_str));
            let text = text.unwrap_or("no display, or no OpenGL");
            fail(3, &format!("no window: {text} (without a screen, `xvfb-run -a` makes a virtual one)"))
        }
    }
}

fn conf() -> Conf {
    Conf {
        miniquad_conf: macroquad::miniquad::conf::Conf {
            window_title: "asunder".to_owned(),
            window_width: 1280,
            window_height: 800,
            sample_count: 4,
            ..Default::default()
        },
        draw_call_vertex_capacity: batch::MOST_VERTICES,
        draw_call_index_capacity: batch::MOST_INDICES,
        ..Conf::default()
    }
}

fn fail(code: u8, error: &str) -> ExitCode {
    eprintln!("viewer: {error}");
    ExitCode::from(code)
}
