//! Outlines in space.

use super::{DebugLine, DebugOptions, HALVINGS, reaches_into};
use crate::space::Volume;
use crate::world::World;
use asunder_geometry::glam::DVec3;
use asunder_geometry::{Aabb3, Ground, HalfSpace, Pose3, Shape3};
use core::ops::ControlFlow;

impl World<Volume> {
    /// Passes the lines that show shapes, boxes, columns, contacts and normals to a closure, in world coordinates, each
    /// with its kind.
    ///
    /// The same world always gives the same lines in the same order; columns are the same for worlds with the same
    /// history. Cost: linear in the number of lines; nothing is allocated.
    ///
    /// ```
    /// use asunder::{Collider3, Cuboid, DebugLine, DebugOptions, Sphere, World3, glam::Vec3};
    /// let mut world = World3::new();
    /// world.insert(Collider3::new(Cuboid::from_half_extents(Vec3::ONE)?));
    /// world.insert(Collider3::new(Sphere::new(1.5)?).sensor());
    /// world.update();
    /// let (mut edges, mut sphere, mut boxes) = (0, vec![], 0);
    /// let options = DebugOptions { boxes: true, ..DebugOptions::default() };
    /// world.debug_lines(&options, &mut |from, to, what| match what {
    ///     DebugLine::Body => edges += 1,
    ///     DebugLine::Sensor => sphere.extend([from, to]),
    ///     _ => boxes += 1,
    /// });
    /// assert_eq!((edges, boxes), (12, 24));
    /// assert!(sphere.iter().all(|point| (point.length() - 1.5).abs() < 1e-6));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn debug_lines(&self, options: &DebugOptions, line: &mut impl FnMut(DVec3, DVec3, DebugLine)) {
        self.draw(None, options, line);
    }

    /// Like [`debug_lines`](World::debug_lines), but passes only the lines that reach into a region, in the same order.
    ///
    /// Of ground, only the part near the region is processed. Cost: linear in the number of lines, plus a test of every
    /// body, contact and box.
    ///
    /// ```
    /// use asunder::{Aabb3, Collider3, DebugOptions, Cuboid, Pose3, World3, glam::Vec3};
    /// let mut world = World3::new();
    /// let crate_ = Collider3::new(Cuboid::from_half_extents(Vec3::ONE)?);
    /// for x in [0.0, 10.0, 20.0] {
    ///     world.insert(crate_.clone().at(Pose3::at([x, 0.0, 0.0])?));
    /// }
    /// world.update();
    /// let (mut count, region) = (0, Aabb3::new(Vec3::splat(-2.0), Vec3::splat(9.5)));
    /// world.debug_lines_in(&region, &DebugOptions::default(), &mut |_, _, _| count += 1);
    /// assert_eq!(count, 12 + 8, "all of the first, and what reaches in of the second");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn debug_lines_in(
        &self,
        region: &Aabb3,
        options: &DebugOptions,
        line: &mut impl FnMut(DVec3, DVec3, DebugLine),
    ) {
        let sides = [region.min, region.max].map(|corner| corner.as_dvec3().to_array());
        self.draw(Some(region), options, &mut |from, to, what| {
            if reaches_into(sides, [from.to_array(), to.to_array()]) {
                line(from, to, what);
            }
        });
    }

    fn draw(
        &self,
        region: Option<&Aabb3>,
        options: &DebugOptions,
        line: &mut dyn FnMut(DVec3, DVec3, DebugLine),
    ) {
        if options.shapes {
            for (_, body) in self.iter().filter(|(_, body)| body.is_enabled()) {
                let (shape, pose, what) = (body.shape(), body.pose(), DebugLine::of(body));
                // With a negative length, the arrow of an unbounded shape leads out of its box.
                let is_endless = shape.outer_radius().is_infinite();
                // An unbounded region is cut to the body's box: infinities turned into its axes would be NaN.
                let there = region.map(|region| shape.bounds(pose, 0.0).intersection(region));
                if is_endless || there != Some(None) {
                    let there = there.flatten();
                    outline((shape, pose), there.as_ref(), options, &mut |from, to| line(from, to, what));
                }
            }
        }
        if options.boxes {
            for bounds in self.boxes.iter().filter(|bounds| bounds.min.is_finite() && bounds.max.is_finite())
            {
                box_edges(bounds.min.as_dvec3(), bounds.max.as_dvec3(), &mut |from, to| {
                    line(from, to, DebugLine::Box);
                });
            }
        }
        if options.columns {
            for column in self.scratch.sweep.columns() {
                let (low, high) = (column.bounds.min.as_dvec3(), column.bounds.max.as_dvec3());
                box_edges(low, high, &mut |from, to| line(from, to, DebugLine::Column));
            }
        }
        if options.contacts || options.normals {
            self.contact_lines(options, line);
        }
    }

    fn contact_lines(&self, options: &DebugOptions, line: &mut dyn FnMut(DVec3, DVec3, DebugLine)) {
        let length = options.length_of_normal();
        for contact in self.contacts() {
            let Some((a, b)) = self.get(contact.a).zip(self.get(contact.b)) else { continue };
            for manifold in contact.manifolds {
                let normal = manifold.normal.as_dvec3();
                let (across, over) = normal.any_orthonormal_pair();
                for point in &manifold.points {
                    let on_a = a.pose().position() + point.anchor_a.as_dvec3();
                    let on_b = b.pose().position() + point.anchor_b.as_dvec3();
                    let middle = (on_a + on_b) / 2.0;
                    if options.contacts {
                        for arm in [across, over].map(|arm| arm * (length / 8.0)) {
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
    /// use asunder::{DebugOptions, Pose3, Cuboid, Shape3, glam::DVec3, glam::Vec3};
    /// let (unit, at) = (Shape3::from(Cuboid::from_half_extents(Vec3::ONE)?), Pose3::at(DVec3::X * 5.0)?);
    /// let mut lines = vec![];
    /// DebugOptions::default().outline3((&unit, &at), &mut |from, to| lines.push([from, to]));
    /// assert_eq!(lines.len(), 12);
    /// assert!(lines.as_flattened().iter().all(|corner| (*corner - DVec3::X * 5.0).abs() == DVec3::ONE));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn outline3(&self, (shape, pose): (&Shape3, &Pose3), line: &mut impl FnMut(DVec3, DVec3)) {
        outline((shape, pose), None, self, line);
    }
}

/// The twelve edges between corners that differ in one coordinate.
fn box_edges(low: DVec3, high: DVec3, line: &mut impl FnMut(DVec3, DVec3)) {
    let pick = |corner: usize, axis: usize| if corner >> axis & 1 == 1 { high[axis] } else { low[axis] };
    let corner = |corner: usize| DVec3::new(pick(corner, 0), pick(corner, 1), pick(corner, 2));
    for axis in 0..3 {
        for from in (0..8).filter(|from| from >> axis & 1 == 0) {
            line(corner(from), corner(from | 1 << axis));
        }
    }
}

/// The outline of a posed shape: faces moved out by the radius, and arcs over the edges between them. Of ground, only
/// what may reach into a region.
fn outline(
    (shape, pose): (&Shape3, &Pose3),
    region: Option<&Aabb3>,
    options: &DebugOptions,
    line: &mut dyn FnMut(DVec3, DVec3),
) {
    match shape {
        Shape3::HalfSpace(half_space) => patch(half_space, pose, options, line),
        Shape3::Compound(compound) => {
            for part in compound.parts() {
                // The part's pose, then the body's.
                let mut moved = |from, to| line(pose.transform(from), pose.transform(to));
                outline((part.shape(), part.pose()), None, options, &mut moved);
            }
        }
        Shape3::TriMesh(mesh) => edges(Ground::Mesh(mesh), pose, region, line),
        Shape3::HeightField(field) => edges(Ground::Field(field), pose, region, line),
        // A hull may be a point or a segment, too.
        _ => match *shape.core().vertices() {
            [center] => ball(pose, pose.transform(center), f64::from(shape.radius()), line),
            [from, to] => rod([from, to].map(|end| pose.transform(end)), f64::from(shape.radius()), line),
            _ => polyhedron(shape, pose, line),
        },
    }
}

/// Every edge of ground, once, or those that may reach into a region.
fn edges(ground: Ground<'_>, pose: &Pose3, region: Option<&Aabb3>, line: &mut dyn FnMut(DVec3, DVec3)) {
    let mut near = Vec::new();
    if let Some(region) = region {
        // If an edge reaches in, both its triangles do.
        let _ = ground.visit_near(&seen_from(pose, region), |triangle| {
            near.push(triangle);
            ControlFlow::Continue(())
        });
        near.sort_unstable();
    }
    let all = if region.is_none() { 0..ground.triangle_count() } else { 0..0 };
    for triangle in near.into_iter().chain(all).filter(|&number| ground.triangle(number).is_some()) {
        let corners = ground.corners(triangle).map(|corner| pose.transform(corner));
        for edge in 0..3 {
            if ground.neighbor(triangle, edge).is_none_or(|(other, _)| triangle < other) {
                line(corners[edge], corners[(edge + 1) % 3]);
            }
        }
    }
}

/// A box, in the axes of a body, around a region.
fn seen_from(pose: &Pose3, region: &Aabb3) -> Aabb3 {
    let (low, high) = (region.min.as_dvec3(), region.max.as_dvec3());
    let corner =
        |i: usize| DVec3::new([low.x, high.x][i & 1], [low.y, high.y][i >> 1 & 1], [low.z, high.z][i >> 2]);
    let corners = (0..8).map(|i| pose.transform_back(corner(i)));
    let far = DVec3::splat(f64::INFINITY);
    let (low, high) = corners.fold((far, -far), |(low, high), at| (low.min(at), high.max(at)));
    // More than the f32 rounding of the region and of ground.
    let reach = region.min.abs().max(region.max.abs()).max_element();
    let slack = 1e-6 * (low.abs().max_element() + high.abs().max_element() + f64::from(reach));
    Aabb3::new((low - slack).as_vec3(), (high + slack).as_vec3())
}

/// A triangle, cuboid or hull, with or without a radius.
fn polyhedron(shape: &Shape3, pose: &Pose3, line: &mut dyn FnMut(DVec3, DVec3)) {
    let (core, basis, radius) = (shape.core(), pose.basis(), f64::from(shape.radius()));
    let topology = core.topology();
    let corner = |vertex: usize| pose.transform(core.vertices()[vertex]);
    let half_edges = topology.half_edges();
    for &edge in topology.edges() {
        let (from, to) = topology.ends(edge.into());
        if radius == 0.0 {
            line(corner(from), corner(to));
            continue;
        }
        let half_edge = half_edges[usize::from(edge)];
        let faces = [half_edge.face, half_edges[usize::from(half_edge.twin)].face];
        let out = faces.map(|face| basis.turn(core.normals()[usize::from(face)]) * radius);
        for out in out {
            line(corner(from) + out, corner(to) + out);
        }
        for end in [from, to] {
            arc(corner(end), out, HALVINGS, line);
        }
    }
}

/// A sphere: a ring about each of the body's axes.
fn ball(pose: &Pose3, center: DVec3, radius: f64, line: &mut dyn FnMut(DVec3, DVec3)) {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| pose.basis().turn(axis) * radius);
    for axis in 0..3 {
        circle(center, [axes[axis], axes[(axis + 1) % 3]], line);
    }
}

/// A capsule: four lines along it, a ring and two half rings at each end.
fn rod([from, to]: [DVec3; 2], radius: f64, line: &mut dyn FnMut(DVec3, DVec3)) {
    if radius == 0.0 {
        return line(from, to);
    }
    let along = (to - from).normalize_or(DVec3::Y);
    let (across, over) = along.any_orthonormal_pair();
    let [along, across, over] = [along, across, over].map(|axis| axis * radius);
    for (end, out) in [(from, -along), (to, along)] {
        circle(end, [across, over], line);
        for side in [across, -across, over, -over] {
            arc(end, [side, out], HALVINGS, line);
        }
    }
    for side in [across, -across, over, -over] {
        line(from + side, to + side);
    }
}

/// A square of a half-space's border, its diagonals, and an arrow to its inside.
fn patch(half_space: &HalfSpace, pose: &Pose3, options: &DebugOptions, line: &mut dyn FnMut(DVec3, DVec3)) {
    let normal = pose.basis().turn(half_space.unit_normal());
    let (across, over) = normal.any_orthonormal_pair();
    let half = options.half_patch();
    let corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
        .map(|(x, y)| pose.position() + across * x + over * y);
    for i in 0..4 {
        line(corners[i], corners[(i + 1) % 4]);
    }
    line(corners[0], corners[2]);
    line(corners[1], corners[3]);
    line(pose.position(), pose.position() - normal * options.length_of_normal());
}

fn circle(center: DVec3, [x, y]: [DVec3; 2], line: &mut dyn FnMut(DVec3, DVec3)) {
    for quarter in [[x, y], [y, -x], [-x, -y], [-y, x]] {
        arc(center, quarter, HALVINGS, line);
    }
}

/// An arc around a centre, the short way from one arm to another of the same length; a line where they are opposite.
fn arc(center: DVec3, [from, to]: [DVec3; 2], halvings: u32, line: &mut dyn FnMut(DVec3, DVec3)) {
    let (sum, length) = (from + to, from.length());
    if halvings == 0 || sum.length() <= 1e-3 * length {
        return line(center + from, center + to);
    }
    let middle = sum * (length / sum.length());
    arc(center, [from, middle], halvings - 1, line);
    arc(center, [middle, to], halvings - 1, line);
}
