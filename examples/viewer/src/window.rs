//! The window: input from the user, and when to step.

use crate::panel;
use crate::player::{Show, show};
use crate::toggles::{Layer, Toggles};
use crate::view::View;
use asunder::glam::DVec3;
use asunder_examples::opened::scene;
use asunder_examples::report::STEP;
use asunder_scenes::stages::{Scene, Stage};
use macroquad::camera::set_default_camera;
use macroquad::color::Color;
use macroquad::input::{
    KeyCode, MouseButton, is_key_pressed, is_mouse_button_down, is_mouse_button_released,
    mouse_delta_position, mouse_position_local, mouse_wheel,
};
use macroquad::texture::get_screen_data;
use macroquad::time::get_frame_time;
use macroquad::window::{clear_background, next_frame, screen_height, screen_width};
use std::error::Error;
use std::fs::OpenOptions;
use std::path::{Path, PathBuf};

const SKY: Color = Color::new(0.90, 0.93, 0.96, 1.0);
/// Time owed beyond this many steps a frame is forgotten: a slow scene runs slower.
const MOST_STEPS: f64 = 2.0;

/// The scene that is shown, and the state of the user's input.
pub(crate) struct Window {
    /// As it was opened, to restart it.
    scene: Scene,
    name: String,
    show: Box<dyn Show>,
    view: View,
    toggles: Toggles,
    is_paused: bool,
    /// Seconds that have passed and have not been stepped yet.
    owed: f64,
    /// Whether dragging the mouse orbits the view.
    is_orbiting: bool,
    /// The scene to open once the screen shows its name: a million bodies take seconds.
    next: Option<Stage>,
}

impl Window {
    /// Opens a scene.
    ///
    /// # Errors
    /// No such scene; what is wrong with a file; a body that moves and has no mass.
    pub(crate) fn open(name: &str, size: Option<usize>, toggles: Toggles) -> Result<Self, Box<dyn Error>> {
        let scene = scene(name, size)?;
        let show = show(&scene)?;
        let view = View::of(show.bounds(), show.is_flat(), 1.6);
        let name = name.to_owned();
        Ok(Self {
            scene,
            name,
            show,
            view,
            toggles,
            is_paused: false,
            owed: 0.0,
            is_orbiting: false,
            next: None,
        })
    }

    /// Shows the scene until the user leaves.
    pub(crate) async fn watch(mut self) {
        self.whole();
        while !is_key_pressed(KeyCode::Escape) {
            self.view.aspect = aspect();
            self.keys();
            let hand = self.mouse();
            self.pass_time(hand);
            self.draw();
            if let Some(stage) = self.next {
                panel::note(&format!("opening {}: {} bodies", stage.name(), stage.usual_size()));
                next_frame().await;
                self.go(stage);
            }
            next_frame().await;
        }
    }

    /// Draws the scene after so many steps, and writes the picture.
    ///
    /// # Errors
    /// The picture has only one colour: nothing was drawn.
    pub(crate) async fn shoot(mut self, file: &Path, steps: u32) -> Result<(), String> {
        (0..steps).for_each(|_| self.show.step(None));
        // One frame for the window to come up, and one for the fonts.
        for _ in 0..2 {
            self.whole();
            self.draw();
            next_frame().await;
        }
        self.draw();
        let picture = get_screen_data();
        let pixels = picture.get_image_data();
        if pixels.iter().all(|pixel| Some(pixel) == pixels.first()) {
            return Err(format!("{}: not written, nothing was drawn", file.display()));
        }
        picture.export_png(&file.to_string_lossy());
        println!("picture        {}", file.display());
        Ok(())
    }

    /// Shows the whole scene.
    fn whole(&mut self) {
        self.view = View::of(self.show.bounds(), self.show.is_flat(), aspect());
    }

    fn keys(&mut self) {
        for (layer, key, _) in Layer::ALL {
            if is_key_pressed(key) {
                self.toggles.flip(layer);
            }
        }
        if is_key_pressed(KeyCode::Space) {
            (self.is_paused, self.owed) = (!self.is_paused, 0.0);
        }
        if is_key_pressed(KeyCode::Period) {
            (self.is_paused, self.owed) = (true, STEP);
        }
        if is_key_pressed(KeyCode::R) {
            self.restart();
        }
        if is_key_pressed(KeyCode::F) {
            self.whole();
        }
        for (key, by) in [(KeyCode::N, 1), (KeyCode::B, Stage::ALL.len() - 1)] {
            if is_key_pressed(key) {
                let here = Stage::ALL.iter().position(|stage| stage.name() == self.name);
                let next = here.map_or(0, |here| (here + by) % Stage::ALL.len());
                self.next = Stage::ALL.get(next).copied();
            }
        }
    }

    /// Opens the scene again; what was opened once can be opened again.
    fn restart(&mut self) {
        if let Ok(show) = show(&self.scene) {
            self.show = show;
        }
    }

    /// Opens a named scene; it is paused if this one is.
    fn go(&mut self, stage: Stage) {
        self.next = None;
        if let Ok(opened) = Self::open(stage.name(), None, self.toggles.clone()) {
            *self = Self { is_paused: self.is_paused, ..opened };
            self.whole();
        }
    }

    /// Orbits or takes hold of a body; returns where the hand is.
    fn mouse(&mut self) -> Option<DVec3> {
        let (at, moved) = (mouse_position_local(), mouse_delta_position());
        let at = [f64::from(at.x), f64::from(-at.y)];
        // The eye moves against the mouse, so that the scene follows it. macroquad returns the last position minus the
        // present one.
        let [x, y] = [f64::from(moved.x), f64::from(-moved.y)];
        if is_mouse_button_released(MouseButton::Left) {
            self.show.release();
            self.is_orbiting = false;
        }
        let is_new = !self.is_orbiting && self.show.held().is_none();
        if is_mouse_button_down(MouseButton::Left) && is_new {
            self.is_orbiting = self.show.hold(self.view.ray(at)).is_none();
        }
        let is_panning =
            is_mouse_button_down(MouseButton::Right) || is_mouse_button_down(MouseButton::Middle);
        if is_panning || (self.is_orbiting && self.view.is_flat) {
            self.view.pan(x * self.view.aspect, y);
        } else if self.is_orbiting {
            self.view.orbit(x * 3.0, y * 2.0);
        }
        let (_, wheel) = mouse_wheel();
        if wheel != 0.0 {
            self.view.zoom(if wheel > 0.0 { 0.88 } else { 1.0 / 0.88 });
        }
        self.show.held().map(|held| self.view.beside(at, held))
    }

    fn pass_time(&mut self, hand: Option<DVec3>) {
        if !self.is_paused {
            self.owed = (self.owed + f64::from(get_frame_time())).min(MOST_STEPS * STEP);
        }
        while self.owed >= STEP {
            self.show.step(hand);
            self.owed -= STEP;
        }
    }

    fn draw(&mut self) {
        clear_background(SKY);
        self.show.draw(&self.view, &self.toggles);
        set_default_camera();
        if self.toggles.shows(Layer::Text) {
            let paused = if self.is_paused { ", paused" } else { "" };
            panel::draw(&format!("{}{paused}", self.name), &self.show.report(), &self.toggles);
        }
    }
}

/// Checks that a picture can be written, since macroquad would panic.
///
/// # Errors
/// Those of the file system.
pub(crate) fn check(file: &Path) -> Result<(), String> {
    let is_new = !file.exists();
    let opened = OpenOptions::new().append(true).create(true).open(file);
    opened.map_err(|error| format!("{}: {error}", file.display()))?;
    if is_new {
        // Leaves no file behind in case no window opens.
        std::fs::remove_file(file).map_err(|error| format!("{}: {error}", file.display()))?;
    }
    Ok(())
}

fn aspect() -> f64 {
    f64::from(screen_width()) / f64::from(screen_height()).max(1.0)
}

/// A picture to write: where, and after how many steps.
pub(crate) type Shot = (PathBuf, u32);
