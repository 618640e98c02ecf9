//! A picture of a world in the plane: its shapes, contact points and normals.

use super::mesh::outlines;
use super::{Canvas, Color, GOLD, INK, MARK, METAL, Pen, STONE, WOOD, middle, varied};
use asunder::glam::{DVec2, DVec3, Vec2};
use asunder::{Collider2, Shape2, World2};

const EARTH: Color = DVec3::new(0.43, 0.34, 0.27);
const GRASS: Color = DVec3::new(0.40, 0.62, 0.27);
const WATER: Color = DVec3::new(0.25, 0.55, 0.85);

/// Of a scene that is more than this many times wider than high only the middle is shown.
const WIDEST: f64 = 6.0;

/// Draws the world as of its last update.
pub fn draw(world: &World2) -> String {
    let bodies: Vec<(&Collider2, Vec<Vec<DVec2>>)> =
        world.iter().map(|(_, body)| (body, outlines(body))).collect();
    // Unbounded shapes are cut off where the rest of the scene ends.
    let bounded = bodies.iter().filter(|(body, _)| body.shape().outer_radius().is_finite());
    let canvas = Canvas::around(bounded.flat_map(|(_, outlines)| outlines.iter().flatten().copied()));
    let mut canvas = canvas.at_most_wide(WIDEST).fine_for(size(world));
    // Scenery first, then sensors, then what moves: bodies hide the grass they stand on, and water hides no body.
    let layers: [fn(&Collider2) -> bool; 3] = [
        |body| body.is_fixed() && !body.is_sensor(),
        |body| body.is_sensor(),
        |body| !body.is_fixed() && !body.is_sensor(),
    ];
    for is_in_layer in layers {
        let in_layer = bodies.iter().enumerate().filter(|(_, (body, _))| is_in_layer(body));
        for (number, (body, outlines)) in in_layer {
            outlines.iter().for_each(|points| draw_body(&mut canvas, body, points, number));
        }
    }
    draw_contacts(&mut canvas, world);
    canvas.finish(DVec3::new(0.62, 0.80, 0.93), DVec3::new(0.95, 0.96, 0.92))
}

/// The median size of the bodies that move, in metres.
fn size(world: &World2) -> f64 {
    let moving = world.iter().filter(|(_, body)| !body.is_fixed());
    let mut sizes: Vec<f32> = moving.map(|(_, body)| body.shape().outer_radius()).collect();
    sizes.sort_unstable_by(f32::total_cmp);
    sizes.get(sizes.len() / 2).map_or(f64::INFINITY, |&radius| 2.0 * f64::from(radius))
}

fn draw_body(canvas: &mut Canvas, body: &Collider2, points: &[DVec2], number: usize) {
    let is_round = points.len() >= 7 && !matches!(body.shape(), Shape2::Compound(_));
    if body.is_sensor() {
        let (color, opacity) = match body.shape() {
            Shape2::Rect(_) if !is_round => (GOLD, 0.35),
            _ if is_round => (GOLD, 0.95),
            _ => (WATER, 0.35),
        };
        canvas.polygon(points, Pen::fill(color).edged(color * 0.7, 1.5).faint(opacity));
    } else if body.is_fixed() {
        draw_ground(canvas, points);
    } else if matches!(body.shape(), Shape2::Rect(rect) if rect.radius() == 0.0) {
        draw_crate(canvas, points, varied(WOOD, number));
    } else if is_round {
        let color = varied(METAL, number);
        canvas.polygon(points, Pen::fill(color).edged(color * 0.55, 1.2));
        // A spoke shows how far the ball has rolled.
        canvas.line(middle(points), points[0], Pen::line(color * 0.55, 1.2));
        canvas.dot(middle(points), 2.0, Pen::fill(color * 0.55));
    } else {
        let color = varied(STONE, number);
        canvas.polygon(points, Pen::fill(color).edged(color * 0.6, 1.2));
    }
}

fn draw_ground(canvas: &mut Canvas, points: &[DVec2]) {
    canvas.polygon(points, Pen::fill(EARTH).edged(EARTH * 0.8, 0.8));
    for (i, &from) in points.iter().enumerate() {
        let to = points[(i + 1) % points.len()];
        let along = (to - from).normalize_or_zero();
        // Outlines are counter-clockwise, so an edge that runs leftwards faces up. Steep edges get no grass.
        if -along.x > 0.6 {
            canvas.line(from, to, Pen::line(GRASS, 4.0));
        }
    }
}

fn draw_crate(canvas: &mut Canvas, points: &[DVec2], color: Color) {
    canvas.polygon(points, Pen::fill(color).edged(color * 0.5, 1.2));
    let center = middle(points);
    let reach = points.windows(2).map(|two| (two[1] - two[0]).length()).fold(f64::INFINITY, f64::min);
    let inner: Vec<DVec2> = points
        .iter()
        .map(|&corner| {
            // A frame of equal width on all sides, however long the crate is.
            let (x, y) = (points[1] - points[0], points[3] - points[0]);
            let toward = center - corner;
            let frame = 0.16 * reach;
            corner
                + x.normalize_or_zero() * frame * toward.dot(x).signum()
                + y.normalize_or_zero() * frame * toward.dot(y).signum()
        })
        .collect();
    canvas.polygon(&inner, Pen::fill(color * 0.88).edged(color * 0.6, 0.8));
    canvas.line(inner[0], inner[2], Pen::line(color * 0.6, 0.8));
}

fn draw_contacts(canvas: &mut Canvas, world: &World2) {
    for contact in world.contacts() {
        let Some(a) = world.get(contact.a) else { continue };
        for manifold in contact.manifolds {
            for point in &manifold.points {
                let place = a.pose().position() + Vec2::as_dvec2(point.anchor_a);
                let tip = place + manifold.normal.as_dvec2() * (9.0 * canvas.fine / canvas.pixels);
                canvas.line(place, tip, Pen::line(INK, 1.0).faint(0.6));
                canvas.dot(place, 2.2, Pen::fill(MARK));
            }
        }
    }
}
