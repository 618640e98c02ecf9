//! The one picture: every pair of shapes in contact.
//!
//! Ten kinds in space make 55 pairs, nine in the plane 45: a triangle each, and together a square of ten by ten.

use crate::camera::{Camera, joined};
use crate::canvas::{Anchor, Canvas, Paint};
use crate::flat::Flat;
use crate::order::far_to_near;
use crate::solid::Solid;
use crate::tint::{CARD, COOL, Color, GREY, INK, NORMAL, WARM};
use crate::touch::{Mark, Touch2, Touch3};
use asunder::glam::{DVec2, DVec3};

/// Pixels from one cell to the next, and between cards.
const CELL: f64 = 178.0;
const GAP: f64 = 6.0;
/// Left, top: where the first cell is.
const CORNER: DVec2 = DVec2::new(120.0, 128.0);
/// How far the half in space stands aside, and the half in the plane below.
const ASIDE: f64 = 16.0;
const APART: f64 = 22.0;
/// Pixels a metre, unless a pair is too large for its card.
const SCALE: f64 = 98.0;
/// Pixels that a pair may take.
const ROOM: f64 = CELL - GAP - 12.0;
/// Length of a normal, in metres.
const ARROW: f64 = 0.34;
/// Cards of the plane's half.
const CARD2: Color = DVec3::new(0.985, 0.982, 0.965);

pub(crate) fn draw(solids: &[Vec<Touch3<'_>>], flats: &[Vec<Touch2<'_>>]) -> String {
    let count = solids.len() as f64;
    let size = DVec2::new(2.0 * CORNER.x + CELL * count + ASIDE, CORNER.y + CELL * count + APART + 60.0);
    let mut canvas = Canvas::new("shapes", size);
    draw_title(&mut canvas, size);
    draw_solids(&mut canvas, solids);
    draw_flats(&mut canvas, flats);
    canvas.finish("every pair of shapes in contact, with contact points and normals")
}

/// A row for each A, a column for each B.
fn draw_solids(canvas: &mut Canvas, solids: &[Vec<Touch3<'_>>]) {
    for (row, touches) in solids.iter().enumerate() {
        for (i, touch) in touches.iter().enumerate() {
            let low = CORNER + DVec2::new((row + i) as f64, row as f64) * CELL + DVec2::X * ASIDE;
            canvas.card(low, DVec2::splat(CELL - GAP), 7.0, &Paint::fill(CARD));
            draw_cell3(canvas, touch, low + (CELL - GAP) * 0.5);
            if row == 0 {
                caption(canvas, low + DVec2::new((CELL - GAP) * 0.5, -12.0), touch.b.name, Anchor::Middle);
            }
            if row + i + 1 == solids.len() {
                caption(canvas, low + DVec2::new(CELL, CELL * 0.5), touch.a.name, Anchor::Start);
            }
        }
    }
}

/// A column for each A, a row for each B.
fn draw_flats(canvas: &mut Canvas, flats: &[Vec<Touch2<'_>>]) {
    for (column, touches) in flats.iter().enumerate() {
        for (i, touch) in touches.iter().enumerate() {
            let low = CORNER + DVec2::new(column as f64, (column + i + 1) as f64) * CELL + DVec2::Y * APART;
            canvas.card(low, DVec2::splat(CELL - GAP), 7.0, &Paint::fill(CARD2));
            draw_cell2(canvas, touch, low + (CELL - GAP) * 0.5);
            if column == 0 {
                caption(canvas, low + DVec2::new(-10.0, CELL * 0.5), touch.b.name, Anchor::End);
            }
            if column + i + 1 == flats.len() {
                caption(
                    canvas,
                    low + DVec2::new((CELL - GAP) * 0.5, CELL + 14.0),
                    touch.a.name,
                    Anchor::Middle,
                );
            }
        }
    }
}

/// What the picture shows, and what its marks mean.
fn draw_title(canvas: &mut Canvas, size: DVec2) {
    let left = CORNER.x + ASIDE;
    canvas.text(DVec2::new(left, 50.0), "Every shape against every other", (28.0, INK, Anchor::Start));
    let right = size.x - CORNER.x;
    let entries = [("A, below", 610.0), ("B, above", 480.0), ("contact points on A and B", 350.0)];
    for (i, (text, from_right)) in entries.into_iter().enumerate() {
        let at = DVec2::new(right - from_right, 44.0);
        match i {
            0 => canvas.card(
                at - DVec2::splat(9.0),
                DVec2::splat(18.0),
                4.0,
                &Paint::fill(COOL.base()).edged(COOL.ink, 1.4),
            ),
            1 => canvas.card(
                at - DVec2::splat(9.0),
                DVec2::splat(18.0),
                4.0,
                &Paint::fill(WARM.base()).edged(WARM.ink, 1.4),
            ),
            _ => {
                canvas.point(at - DVec2::Y * 3.5, 3.6, COOL.ink);
                canvas.point(at + DVec2::Y * 3.5, 3.6, WARM.ink);
            }
        }
        canvas.text(at + DVec2::new(17.0, 6.0), text, (17.0, INK, Anchor::Start));
    }
    let at = DVec2::new(right - 110.0, 44.0);
    canvas.arrow(at + DVec2::Y * 12.0, at - DVec2::Y * 14.0, NORMAL);
    canvas.text(at + DVec2::new(15.0, 6.0), "normal", (17.0, INK, Anchor::Start));
    canvas.text(DVec2::new(right, size.y - 60.0), "above: in space, 55 pairs", (17.0, GREY, Anchor::End));
    canvas.text(DVec2::new(right, size.y - 36.0), "left: in the plane, 45 pairs", (17.0, GREY, Anchor::End));
}

/// A caption of one or two words, one below the other.
fn caption(canvas: &mut Canvas, at: DVec2, name: &str, anchor: Anchor) {
    match (name.split_once(' '), anchor) {
        (Some((first, second)), Anchor::Start | Anchor::End) => {
            canvas.text(at - DVec2::Y * 7.0, first, (16.0, INK, anchor));
            canvas.text(at + DVec2::Y * 12.0, second, (16.0, INK, anchor));
        }
        _ => canvas.text(at + DVec2::Y * 4.0, name, (16.0, INK, anchor)),
    }
}

fn draw_cell3(canvas: &mut Canvas, touch: &Touch3<'_>, middle: DVec2) {
    let order = far_to_near(touch, Camera::above().toward_viewer());
    let tint = |is_b: bool| if is_b { &WARM } else { &COOL };
    let frame = |camera: &Camera| {
        joined(order.iter().map(|body| Solid::new(body.shape, &body.pose, tint(body.is_b), camera).frame()))
    };
    let camera = fitted(Camera::above(), frame, middle);
    for body in &order {
        canvas.begin(if body.is_b { 0.80 } else { 1.0 });
        Solid::new(body.shape, &body.pose, tint(body.is_b), &camera).draw(canvas);
        canvas.end();
    }
    draw_marks(canvas, &touch.marks, &camera);
}

fn draw_cell2(canvas: &mut Canvas, touch: &Touch2<'_>, middle: DVec2) {
    let parts = touch.parts();
    let tint = |is_b: bool| if is_b { &WARM } else { &COOL };
    let frame = |camera: &Camera| {
        joined(parts.iter().map(|body| Flat::new(body.shape, &body.pose, tint(body.is_b), camera).frame()))
    };
    let camera = fitted(Camera::front(), frame, middle);
    for body in &parts {
        Flat::new(body.shape, &body.pose, tint(body.is_b), &camera).draw(canvas);
    }
    draw_marks(canvas, &touch.marks, &camera);
}

/// The camera moved, and scaled if it must be, so that the rectangle of the picture around a pair fits its card.
fn fitted(camera: Camera, frame: impl Fn(&Camera) -> [DVec2; 2], middle: DVec2) -> Camera {
    let [low, high] = frame(&camera.scaled(1.0));
    let camera = camera.scaled(SCALE.min(ROOM / (high - low).max_element()));
    camera.centered(frame(&camera), middle)
}

/// Normals, and over them the points on both surfaces.
fn draw_marks(canvas: &mut Canvas, marks: &[Mark], camera: &Camera) {
    for mark in marks {
        let tip = mark.on_a + mark.normal * ARROW;
        canvas.arrow(camera.place(mark.on_a), camera.place(tip), NORMAL);
    }
    for mark in marks {
        canvas.point(camera.place(mark.on_a), 3.0, COOL.ink);
        canvas.point(camera.place(mark.on_b), 3.0, WARM.ink);
    }
}
