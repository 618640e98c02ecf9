//! The one large picture: every pair of shapes in contact.
//!
//! Ten kinds in space make 55 pairs, nine in the plane 45: two triangles that together fill a square of ten by ten.

use crate::camera::{Camera, joined};
use crate::canvas::{Anchor, Canvas, Paint};
use crate::flat::Flat;
use crate::order::{far_to_near, parts2, parts3};
use crate::solid::Solid;
use crate::tint::{CARD, COOL, Color, GREY, INK, NORMAL, Tint, WARM};
use crate::touch::{Mark, Touch2, Touch3};
use asunder::glam::{DVec2, DVec3};

/// Pixels from one cell to the next, and between cards.
const CELL: f64 = 178.0;
const GAP: f64 = 6.0;
/// Left, top: the corner of the first cell.
const CORNER: DVec2 = DVec2::new(120.0, 128.0);
/// By how much the half in space is moved right, and the half in the plane down.
const ASIDE: f64 = 16.0;
const APART: f64 = 22.0;
/// Pixels a metre, unless a pair is too large for its card.
const SCALE: f64 = 98.0;
/// Pixels that a pair may fill.
const ROOM: DVec2 = DVec2::splat(CELL - GAP - 12.0);
/// Length of a normal, in metres.
const ARROW: f64 = 0.34;
/// Background of the cards in the plane's half.
const CARD2: Color = DVec3::new(0.985, 0.982, 0.965);

pub(crate) fn draw(solids: &[Vec<Touch3<'_>>], flats: &[Vec<Touch2<'_>>]) -> String {
    let count = solids.len() as f64;
    let size = DVec2::new(2.0 * CORNER.x + CELL * count + ASIDE, CORNER.y + CELL * count + APART + 44.0);
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

/// The title, and a key to the marks.
fn draw_title(canvas: &mut Canvas, size: DVec2) {
    let left = CORNER.x + ASIDE;
    canvas.text(DVec2::new(left, 50.0), "Every shape against every other", (28.0, INK, Anchor::Start));
    let halves = "upper right: in space, 55 pairs; lower left: in the plane, 45 pairs";
    canvas.text(DVec2::new(left, 76.0), halves, (16.0, GREY, Anchor::Start));
    let from_right = |x: f64| DVec2::new(size.x - CORNER.x - x, 58.0);
    for (at, tint) in [(from_right(640.0), COOL), (from_right(520.0), WARM)] {
        let paint = Paint::fill(tint.base()).edged(tint.ink, 1.4);
        canvas.card(at - 9.0, DVec2::splat(18.0), 4.0, &paint);
    }
    canvas.point(from_right(400.0) + DVec2::Y * 4.0, 4.0, COOL.ink);
    canvas.point(from_right(400.0) - DVec2::Y * 4.0, 4.0, WARM.ink);
    let normal = from_right(150.0);
    canvas.arrow(normal + DVec2::Y * 12.0, normal - DVec2::Y * 14.0, NORMAL);
    let texts = [
        (640.0, "A, below"),
        (520.0, "B, above"),
        (400.0, "contact points on A and B"),
        (150.0, "normal, A to B"),
    ];
    for (x, text) in texts {
        canvas.text(from_right(x) + DVec2::new(16.0, 6.0), text, (16.0, INK, Anchor::Start));
    }
}

/// A caption of one word, or of two in two lines.
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
    let camera = Camera::above().scaled(SCALE);
    let mut bodies = parts3(&touch.a.shape, &touch.pose_a, false);
    bodies.extend(parts3(&touch.b.shape, &touch.pose_b, true));
    let bodies = far_to_near(bodies, camera.toward_viewer());
    let camera = camera.fitted(ROOM, middle, |camera| {
        joined(bodies.iter().map(|body| Solid::new(body.shape, &body.pose, tint(body.is_b), camera).frame()))
    });
    for body in &bodies {
        // B is translucent, to show what it lies on.
        canvas.begin(if body.is_b { 0.80 } else { 1.0 });
        Solid::new(body.shape, &body.pose, tint(body.is_b), &camera).draw(canvas);
        canvas.end();
    }
    draw_marks(canvas, &touch.marks, &camera);
}

fn draw_cell2(canvas: &mut Canvas, touch: &Touch2<'_>, middle: DVec2) {
    let mut bodies = parts2(&touch.a.shape, &touch.pose_a, false);
    bodies.extend(parts2(&touch.b.shape, &touch.pose_b, true));
    let camera = Camera::front().scaled(SCALE).fitted(ROOM, middle, |camera| {
        joined(bodies.iter().map(|body| Flat::new(body.shape, &body.pose, tint(body.is_b), camera).frame()))
    });
    for body in &bodies {
        Flat::new(body.shape, &body.pose, tint(body.is_b), &camera).draw(canvas);
    }
    draw_marks(canvas, &touch.marks, &camera);
}

/// The first body is cool, the second warm.
fn tint(is_b: bool) -> &'static Tint {
    if is_b { &WARM } else { &COOL }
}

/// Draws normals, and over them the points on both surfaces.
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
