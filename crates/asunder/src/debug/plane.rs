//! Outlines in the plane.

use super::{DebugLine, DebugOptions, HALVINGS, reaches_into};
use crate::space::Plane;
use crate::world::World;
use asunder_geometry::glam::DVec2;
use asunder_geometry::{Aabb2, HalfPlane, Pose2, Shape2};

impl World<Plane> {
    /// Passes the lines that show shapes, boxes, columns, contacts and normals to a closure, in world coordinates, each
    /// with its kind.
    ///
    /// The same world always gives the same lines in the same order; columns are the same for worlds with the same
    /// history. Cost: linear in the number of lines; nothing is allocated.
    ///
    /// ```
    /// use asunder::{Collider2, DebugLine, DebugOptions, Rect, World2, glam::{DVec2, Vec2}};
    /// let mut world = World2::new();
    /// world.insert(Collider2::new(Rect::from_half_extents(Vec2::ONE)?));
    /// let mut lines = vec![];
    /// world.debug_lines(&DebugOptions::default(), &mut |from, to, what| lines.push((from, to, what)));
    /// assert_eq!(lines.len(), 4);
    /// assert_eq!(lines[0], (DVec2::new(-1.0, -1.0), DVec2::new(1.0, -1.0), DebugLine::Body));
    /// # Ok::<(), asunder::ExtentError>(())
    /// ```
    pub fn debug_lines(&self, options: &DebugOptions, line: &mut impl FnMut(DVec2, DVec2, DebugLine)) {
        self.draw(None, options, line);
    }

    /// Like [`debug_lines`](World::debug_lines), but passes only the lines that reach into a region, in the same order.
    ///
    /// Cost: a test of every body, contact and box, and of everything that is drawn of a body that reaches in; nothing
    /// is allocated.
    ///
    /// ```
    /// use asunder::{Aabb2, Collider2, DebugOptions, Rect, Pose2, World2, glam::Vec2};
    /// let mut world = World2::new();
    /// let crate_ = Collider2::new(Rect::from_half_extents(Vec2::ONE)?);
    /// for x in [0.0, 10.0, 20.0] {
    ///     world.insert(crate_.clone().at(Pose2::at([x, 0.0])?));
    /// }
    /// world.update();
    /// let (mut count, region) = (0, Aabb2::new(Vec2::splat(-2.0), Vec2::splat(9.5)));
    /// world.debug_lines_in(&region, &DebugOptions::default(), &mut |_, _, _| count += 1);
    /// assert_eq!(count, 4 + 3, "all of the first, and what reaches in of the second");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn debug_lines_in(
        &self,
        region: &Aabb2,
        options: &DebugOptions,
        line: &mut impl FnMut(DVec2, DVec2, DebugLine),
    ) {
        let sides = [region.min, region.max].map(|corner| corner.as_dvec2().to_array());
        self.draw(Some(region), options, &mut |from, to, what| {
            if reaches_into(sides, [from.to_array(), to.to_array()]) {
                line(from, to, what);
            }
        });
    }

    fn draw(
        &self,
        region: Option<&Aabb2>,
        options: &DebugOptions,
        line: &mut dyn FnMut(DVec2, DVec2, DebugLine),
    ) {
        if options.shapes {
            for (_, body) in self.iter().filter(|(_, body)| body.is_enabled()) {
                let (shape, pose, what) = (body.shape(), body.pose(), DebugLine::of(body));
                // With a negative length, the arrow of an unbounded shape leads out of its box.
                let is_endless = shape.outer_radius().is_infinite();
                if region.is_none_or(|region| is_endless || shape.bounds(pose, 0.0).overlaps(region)) {
                    outline(shape, pose, options, &mut |from, to| line(from, to, what));
                }
            }
        }
        if options.boxes {
            for bounds in self.boxes.iter().filter(|bounds| bounds.min.is_finite() && bounds.max.is_finite())
            {
                rectangle(bounds.min.as_dvec2(), bounds.max.as_dvec2(), &mut |from, to| {
                    line(from, to, DebugLine::Box);
                });
            }
        }
        if options.columns {
            for column in self.scratch.sweep.columns() {
                let [low, high] =
                    [column.bounds.min, column.bounds.max].map(|corner| corner.as_dvec3().truncate());
                rectangle(low, high, &mut |from, to| line(from, to, DebugLine::Column));
            }
        }
        if options.contacts || options.normals {
            self.contact_lines(options, line);
        }
    }

    fn contact_lines(&self, options: &DebugOptions, line: &mut dyn FnMut(DVec2, DVec2, DebugLine)) {
        let length = options.length_of_normal();
        for contact in self.contacts() {
            let Some((a, b)) = self.get(contact.a).zip(self.get(contact.b)) else { continue };
            for manifold in contact.manifolds {
                let normal = manifold.normal.as_dvec2();
                for point in &manifold.points {
                    let on_a = a.pose().position() + point.anchor_a.as_dvec2();
                    let on_b = b.pose().position() + point.anchor_b.as_dvec2();
                    let middle = (on_a + on_b) / 2.0;
                    if options.contacts {
                        for arm in [normal, normal.perp()].map(|arm| arm * (length / 8.0)) {
                            line(middle - arm, middle + arm, DebugLine::Contact);
                        }
                    }
                    if options.normals {
                        line(middle, middle + normal * length, DebugLine::Normal);
                    }
                }
            }
        }
    }
}

impl DebugOptions {
    /// Passes the outline of a shape to a closure, in world coordinates. The shape need not be in a world: it may be
    /// that of a query, or the preview of something to be built. Lengths are those of the options.
    ///
    /// To draw only part of a large world, use [`debug_lines_in`](World::debug_lines_in).
    ///
    /// ```
    /// use asunder::{DebugOptions, Pose2, Rect, Shape2, glam::DVec2, glam::Vec2};
    /// let (unit, at) = (Shape2::from(Rect::from_half_extents(Vec2::ONE)?), Pose2::at(DVec2::X * 5.0)?);
    /// let mut lines = vec![];
    /// DebugOptions::default().outline2((&unit, &at), &mut |from, to| lines.push([from, to]));
    /// assert_eq!(lines.len(), 4);
    /// assert!(lines.as_flattened().iter().all(|corner| (*corner - DVec2::X * 5.0).abs() == DVec2::ONE));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn outline2(&self, (shape, pose): (&Shape2, &Pose2), line: &mut impl FnMut(DVec2, DVec2)) {
        outline(shape, pose, self, line);
    }
}

fn rectangle(low: DVec2, high: DVec2, line: &mut impl FnMut(DVec2, DVec2)) {
    around(&[low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)], line);
}

fn around(corners: &[DVec2], line: &mut impl FnMut(DVec2, DVec2)) {
    for (i, &corner) in corners.iter().enumerate() {
        line(corner, corners[(i + 1) % corners.len()]);
    }
}

/// The outline of a posed shape: edges moved out by the radius, and arcs between them.
fn outline(shape: &Shape2, pose: &Pose2, options: &DebugOptions, line: &mut dyn FnMut(DVec2, DVec2)) {
    match shape {
        Shape2::HalfPlane(half_plane) => border(half_plane, pose, options, line),
        Shape2::Compound(compound) => {
            for part in compound.parts() {
                // The part's pose, then the body's.
                let mut moved = |from, to| line(pose.transform(from), pose.transform(to));
                outline(part.shape(), part.pose(), options, &mut moved);
            }
        }
        Shape2::Chain(chain) => {
            let back = if chain.is_closed() { chain.vertices().first() } else { None };
            let next = chain.vertices().iter().skip(1).chain(back);
            for (&from, &to) in chain.vertices().iter().zip(next) {
                line(pose.transform(from), pose.transform(to));
            }
        }
        Shape2::Circle(circle) => {
            let radius = f64::from(circle.radius());
            let center = pose.position();
            let quarters =
                [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y].map(|q| pose.rotation().turn(q) * radius);
            for i in 0..4 {
                arc(center, [quarters[i], quarters[(i + 1) % 4]], HALVINGS, line);
            }
            line(center, center + quarters[0]);
        }
        _ => {
            let (core, radius) = (shape.core(), f64::from(shape.radius()));
            let normals = core.normals();
            let corner = |i: usize| pose.transform(core.vertices()[i % normals.len()]);
            let out = |i: usize| pose.rotation().turn(normals[i % normals.len()]) * radius;
            for i in 0..normals.len() {
                line(corner(i) + out(i), corner(i + 1) + out(i));
                if radius > 0.0 {
                    arc(corner(i + 1), [out(i), out(i + 1)], HALVINGS, line);
                }
            }
        }
    }
}

/// The line of a half-plane, and an arrow to its inside.
fn border(half_plane: &HalfPlane, pose: &Pose2, options: &DebugOptions, line: &mut dyn FnMut(DVec2, DVec2)) {
    let normal = pose.rotation().turn(half_plane.unit_normal());
    let (center, along) = (pose.position(), normal.perp() * options.half_patch());
    line(center - along, center + along);
    line(center, center - normal * options.length_of_normal());
}

/// An arc around a centre, counter-clockwise from one arm to another of the same length, at most half a turn.
fn arc(center: DVec2, [from, to]: [DVec2; 2], halvings: u32, line: &mut dyn FnMut(DVec2, DVec2)) {
    if halvings == 0 {
        return line(center + from, center + to);
    }
    let sum = from + to;
    let length = from.length();
    let middle = if sum.length() > 1e-3 * length { sum * (length / sum.length()) } else { from.perp() };
    arc(center, [from, middle], halvings - 1, line);
    arc(center, [middle, to], halvings - 1, line);
}
