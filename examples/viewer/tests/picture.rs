//! Takes pictures under a virtual display, where there is one: needs `xvfb-run` and a driver for OpenGL.

use macroquad::texture::Image;
use std::collections::BTreeSet;
use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output};

/// The viewer's exit code where no window can be opened.
const NO_WINDOW: i32 = 3;

fn viewer() -> &'static str {
    env!("CARGO_BIN_EXE_asunder-viewer")
}

/// Not with `println`, which is swallowed if the test passes: silence would suggest that a picture was made.
fn say(what: &str) {
    let _ = writeln!(std::io::stderr(), "{what}");
}

/// Takes a picture; `None` where the system has no virtual display.
fn shoot(scene: &[&str], file: &Path) -> Option<Output> {
    let mut command = Command::new("xvfb-run");
    command.arg("-a").arg(viewer()).args(scene).arg("--shot").arg(file);
    let Ok(output) = command.output() else {
        say(&format!("SKIPPED: no xvfb-run on this system, so no picture of {scene:?} was made"));
        return None;
    };
    if output.status.code() == Some(NO_WINDOW) {
        let why = String::from_utf8_lossy(&output.stderr);
        say(&format!("SKIPPED: no window under xvfb-run, so no picture of {scene:?} was made: {why}"));
        return None;
    }
    Some(output)
}

/// The colours in the picture of a scene, except where the text may be.
fn colors(scene: &[&str], name: &str) -> Result<Option<BTreeSet<[u8; 4]>>, Box<dyn Error>> {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_file(&file);
    let Some(output) = shoot(scene, &file) else { return Ok(None) };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let bytes = std::fs::read(&file)?;
    let image = Image::from_file_with_format(&bytes, None)?;
    assert_eq!((image.width, image.height), (1280, 800));
    say(&format!("made a picture of {scene:?}"));
    Ok(Some(image.get_image_data().iter().copied().collect()))
}

#[test]
fn a_scene_in_space_is_drawn() -> Result<(), Box<dyn Error>> {
    let scene = ["--scene", "stack", "--frame", "30", "--flip", "text"];
    let Some(colors) = colors(&scene, "stack.png")? else { return Ok(()) };
    // The sky, the floor's top, and two sides of boxes in twenty tones.
    assert!(colors.len() > 20, "{} colours", colors.len());
    Ok(())
}

#[test]
fn a_scene_in_the_plane_is_drawn() -> Result<(), Box<dyn Error>> {
    let scene = ["--scene", "letters", "--bodies", "60", "--frame", "120", "--flip", "text,contacts,normals"];
    let Some(colors) = colors(&scene, "letters.png")? else { return Ok(()) };
    assert!(colors.len() > 20, "{} colours", colors.len());
    Ok(())
}

#[test]
fn without_a_display_it_says_so_and_leaves() {
    let mut command = Command::new(viewer());
    command.args(["--scene", "stack", "--shot"]).arg(Path::new(env!("CARGO_TARGET_TMPDIR")).join("none.png"));
    let output = command.env_remove("WAYLAND_DISPLAY").env("DISPLAY", ":4711").output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    if cfg!(target_os = "linux") {
        assert_eq!(output.status.code(), Some(NO_WINDOW), "{text}");
        assert!(text.starts_with("viewer: no window: ") && text.lines().count() == 1, "{text}");
    }
}

#[test]
fn wrong_scenes_and_files_are_told_before_a_window_opens() {
    for (options, said) in [
        (["--scene", "no such stage", "--shot", "x.png"], "no such stage"),
        (["--scene", "stack", "--shot", "/no such folder/x.png"], "/no such folder/x.png"),
    ] {
        let output = Command::new(viewer()).args(options).output().unwrap();
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(text.contains(said), "{text}");
    }
}
