//! A picture of a world in space: orthographic, from above, nearer bodies drawn over further ones.

use super::mesh::{Face, faces, parts};
use super::order::far_to_near;
use super::{BALL, Canvas, Color, GOLD, MARK, METAL, Pen, RUBBER, SCENERY, STONE, WOOD, varied};
use asunder::glam::{DVec2, DVec3, Vec3};
use asunder::{BodyKey3, Collider3, Shape3, World3};
use std::collections::{BTreeMap, BTreeSet};

/// A landscape with more fixed bodies than this is not drawn whole.
const PIECES: usize = 12_000;
/// How many bodies of such a landscape are drawn, around one that moves.
const AROUND: usize = 2_000;
/// Metres between the lines that are drawn on large faces of the scenery.
const TILE: f64 = 1.0;
/// Scenery that hides more than this share of the moving bodies, such as the walls of a pit, is drawn as a shadow.
const HIDES: f64 = 0.04;
/// The most pairs of scenery and moving body that are examined for that.
const LOOKS: usize = 20_000_000;
/// A contact point is shown if at most this much of its own two bodies, in metres, lies in front of it.
const SEEN_THROUGH: f64 = 0.01;

struct View {
    right: DVec3,
    up: DVec3,
    toward_viewer: DVec3,
    light: DVec3,
}

/// A convex part of a body, in the world.
struct Solid {
    part: Collider3,
    /// The number of the body it is part of.
    body: usize,
    faces: Vec<Face>,
}

/// Draws the world as of its last update.
pub fn draw(world: &World3) -> String {
    let view = View::new(DVec3::new(0.60, 0.62, 0.90));
    let bodies = shown(world);
    let solids: Vec<Solid> = bodies
        .iter()
        .enumerate()
        .flat_map(|(body, (_, collider))| parts(collider).into_iter().map(move |part| Solid::new(part, body)))
        .collect();
    let numbers: BTreeMap<_, usize> = bodies.iter().enumerate().map(|(i, (key, _))| (*key, i)).collect();
    let outlines: Vec<Vec<DVec2>> = solids.iter().map(|solid| view.outline(solid)).collect();
    let convex: Vec<&Collider3> = solids.iter().map(|solid| &solid.part).collect();
    let order = far_to_near(&convex, &outlines, view.toward_viewer);
    // The place in the drawing order of each body's last part.
    let mut turn = vec![0; numbers.len()];
    order.iter().enumerate().for_each(|(i, &number)| turn[solids[number].body] = i);

    // A point is drawn right after the later of its two bodies, so that whatever hides them also hides it.
    let mut points: BTreeMap<usize, Vec<DVec3>> = BTreeMap::new();
    for contact in world.contacts() {
        let (Some(&a), Some(&b)) = (numbers.get(&contact.a), numbers.get(&contact.b)) else { continue };
        for point in contact.manifolds.iter().flat_map(|manifold| &manifold.points) {
            let Some(body) = world.get(contact.a) else { continue };
            let place = body.pose().position() + Vec3::as_dvec3(point.anchor_a);
            let mut both = solids.iter().filter(|solid| [a, b].contains(&solid.body));
            let is_seen = both.all(|solid| solid.depth_over(place, &view) < SEEN_THROUGH);
            if is_seen {
                // Ground is drawn triangle by triangle; those that hide the point are drawn after the body that stands
                // there.
                let later = if is_ground(world, contact.a) {
                    turn[b]
                } else if is_ground(world, contact.b) {
                    turn[a]
                } else {
                    turn[a].max(turn[b])
                };
                points.entry(later).or_default().push(place);
            }
        }
    }
    // Unbounded shapes are cut off where the rest of the scene ends.
    let bounded =
        solids.iter().zip(&outlines).filter(|(solid, _)| solid.part.shape().outer_radius().is_finite());
    let shadows = shadows(&solids, &view);
    let mut canvas = Canvas::around(bounded.flat_map(|(_, outline)| outline.iter().copied()));
    for (i, &number) in order.iter().enumerate() {
        solids[number].draw(&mut canvas, &view, shadows.contains(&number));
        for &place in points.get(&i).into_iter().flatten() {
            let radius = (0.035 * canvas.pixels).clamp(0.8, 3.0);
            canvas.dot(view.project(place), radius, Pen::fill(MARK));
        }
    }
    canvas.finish(DVec3::new(0.93, 0.95, 0.97), DVec3::new(0.84, 0.87, 0.90))
}

fn is_ground(world: &World3, key: BodyKey3) -> bool {
    world.get(key).is_some_and(|body| body.shape().is_ground())
}

/// The numbers of the scenery solids that hide too much.
fn shadows(solids: &[Solid], view: &View) -> BTreeSet<usize> {
    let is_scenery = |solid: &&Solid| solid.part.is_fixed();
    let movers: Vec<DVec3> =
        solids.iter().filter(|solid| !is_scenery(solid)).map(|solid| solid.part.pose().position()).collect();
    let scenery = solids.iter().enumerate().filter(|(_, solid)| is_scenery(solid));
    if scenery.clone().count().saturating_mul(movers.len()) > LOOKS {
        return BTreeSet::new();
    }
    let hides_much = |solid: &Solid| {
        let hidden = movers.iter().filter(|&&mover| solid.depth_over(mover, view) > 0.0).count();
        hidden as f64 > HIDES * movers.len() as f64
    };
    scenery.filter(|(_, solid)| hides_much(solid)).map(|(number, _)| number).collect()
}

/// The bodies that are drawn: all of them, or of a large landscape a square around the moving body nearest to its
/// middle.
fn shown(world: &World3) -> Vec<(BodyKey3, &Collider3)> {
    let mut bodies: Vec<_> = world.iter().collect();
    if bodies.iter().filter(|(_, body)| body.is_fixed()).count() <= PIECES {
        return bodies;
    }
    let place = |body: &Collider3| body.pose().position();
    let middle = bodies.iter().map(|(_, body)| place(body)).sum::<DVec3>() / bodies.len() as f64;
    let moving = bodies.iter().filter(|(_, body)| !body.is_fixed()).map(|(_, body)| place(body));
    let near = moving.min_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle))).unwrap_or(middle);
    let away = |body: &Collider3| (place(body) - near).abs().max_element();
    let mut ways: Vec<f64> = bodies.iter().map(|(_, body)| away(body)).collect();
    let (_, &mut far, _) = ways.select_nth_unstable_by(AROUND, f64::total_cmp);
    bodies.retain(|(_, body)| away(body) <= far);
    bodies
}

impl View {
    fn new(toward_viewer: DVec3) -> Self {
        let toward_viewer = toward_viewer.normalize();
        let right = DVec3::Y.cross(toward_viewer).normalize();
        Self {
            right,
            up: toward_viewer.cross(right),
            toward_viewer,
            light: DVec3::new(-0.25, 1.0, 0.55).normalize(),
        }
    }

    fn project(&self, point: DVec3) -> DVec2 {
        DVec2::new(point.dot(self.right), point.dot(self.up))
    }

    fn outline(&self, solid: &Solid) -> Vec<DVec2> {
        solid.faces.iter().flat_map(|face| &face.corners).map(|&corner| self.project(corner)).collect()
    }

    fn shade(&self, color: Color, normal: DVec3) -> Color {
        color * (0.48 + 0.56 * normal.dot(self.light).max(0.0))
    }
}

impl Solid {
    fn new(part: Collider3, body: usize) -> Self {
        let faces = faces(&part);
        Self { part, body, faces }
    }

    /// How much of the body, in metres, lies between a point and the viewer.
    fn depth_over(&self, point: DVec3, view: &View) -> f64 {
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for face in &self.faces {
            let (height, rise) =
                (face.normal.dot(point - face.corners[0]), face.normal.dot(view.toward_viewer));
            if rise > 1e-9 {
                leave = leave.min(-height / rise);
            } else if rise < -1e-9 {
                enter = enter.max(-height / rise);
            } else if height > 0.0 {
                return 0.0;
            }
        }
        (leave - enter).max(0.0)
    }

    fn draw(&self, canvas: &mut Canvas, view: &View, is_shadow: bool) {
        let color = self.color(self.body);
        if let Some(ends) = self.rod() {
            return self.draw_rod(canvas, view, ends, color);
        }
        for face in self.faces.iter().filter(|face| face.normal.dot(view.toward_viewer) > 0.0) {
            let shaded = view.shade(color, face.normal);
            let corners: Vec<DVec2> = face.corners.iter().map(|&corner| view.project(corner)).collect();
            let is_round = self.part.shape().radius() > 0.0;
            let mut pen = Pen::fill(shaded).edged(if is_round { shaded } else { shaded * 0.62 }, 0.6);
            if self.part.is_sensor() {
                pen = pen.faint(0.4);
            }
            if is_shadow {
                pen = pen.faint(0.12);
            }
            canvas.polygon(&corners, pen);
            if self.part.is_sensor() || is_shadow {
                continue;
            }
            if self.part.is_fixed() {
                draw_tiles(canvas, view, face, Pen::line(shaded * 0.85, 0.5));
            } else if matches!(self.part.shape(), Shape3::Cuboid(_)) && !is_round {
                draw_boards(canvas, &corners, Pen::line(shaded * 0.72, 0.6));
            }
        }
    }

    /// The ends of a ball's or capsule's core segment in the world; `None` for other shapes.
    fn rod(&self) -> Option<[DVec3; 2]> {
        let core = self.part.shape().core();
        let (&first, &last) = (core.vertices().first()?, core.vertices().last()?);
        let is_round = self.part.shape().radius() > 0.0 && core.normals().is_empty();
        is_round.then(|| [first, last].map(|vertex| self.part.pose().transform(vertex)))
    }

    /// In parallel projection a capsule is a thick line with round ends, and so are its highlights: a few strokes in
    /// place of a hundred faces.
    fn draw_rod(&self, canvas: &mut Canvas, view: &View, ends: [DVec3; 2], color: Color) {
        let radius = f64::from(self.part.shape().radius());
        let lit = DVec2::new(view.light.dot(view.right), view.light.dot(view.up));
        let opacity = if self.part.is_sensor() { 0.4 } else { 1.0 };
        for (share, tone) in [(1.0, 0.5), (0.86, 0.66), (0.66, 0.82), (0.42, 0.95), (0.18, 1.06)] {
            let [from, to] = ends.map(|end| view.project(end) + lit * (radius * 0.55 * (1.0 - share)));
            let pen = Pen::line(color * tone, 2.0 * radius * share * canvas.pixels);
            canvas.line(from, to, pen.faint(opacity));
        }
    }

    fn color(&self, number: usize) -> Color {
        if self.part.is_sensor() {
            return GOLD;
        }
        if self.part.is_fixed() {
            return SCENERY;
        }
        // In a prism, two faces touch all others; in a rock, none does.
        let corners = self.faces.iter().map(|face| face.corners.len());
        let most = corners.max().unwrap_or(0);
        let base = match self.part.shape() {
            Shape3::Sphere(_) => BALL,
            Shape3::Capsule(_) => RUBBER,
            Shape3::Cuboid(_) => WOOD,
            Shape3::Hull(_) if most + 2 == self.faces.len() => METAL,
            _ => STONE,
        };
        varied(base, number)
    }
}

fn draw_tiles(canvas: &mut Canvas, view: &View, face: &Face, pen: Pen) {
    let [a, b, c, d] = face.corners[..] else { return };
    for [from, along, far, far_along] in [[a, b, d, c], [b, c, a, d]] {
        let count = ((along - from).length() / TILE).round().min(400.0) as usize;
        for i in 1..count {
            let share = i as f64 / count as f64;
            canvas.line(view.project(from.lerp(along, share)), view.project(far.lerp(far_along, share)), pen);
        }
    }
}

/// The frame of a crate's side.
fn draw_boards(canvas: &mut Canvas, corners: &[DVec2], pen: Pen) {
    let [a, b, c, d] = corners[..] else { return };
    let middle = (a + b + c + d) / 4.0;
    let inner = [a, b, c, d].map(|corner| corner.lerp(middle, 0.28));
    canvas.polygon(&inner, pen);
}
