//! parry3d in f32 and in f64, with the same queries.
//!
//! Both crates have the same names, so the queries are written once. Positions are rounded to the crate's number type,
//! and the stored quaternion is normalised in f64 first: the least loss that its types allow.

use asunder_scenes::pairs::PosedPair3;
use glam::DVec3;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A peer's answers for a pair; `None` where it has no such shape or no such query.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Said {
    /// Whether the shapes share a point.
    pub overlaps: Option<bool>,
    /// The distance in a gap, else minus the depth, in metres; 0 where it finds neither. It may be a NaN.
    pub separation: Option<f64>,
    /// Whether some query, or making the shapes, panicked.
    pub panicked: bool,
}

/// Contact points of a peer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// That of the deepest one, in metres; it may be a NaN.
    pub separation: f64,
    /// From A to B; it may be a NaN.
    pub normal: DVec3,
    /// How many there are.
    pub points: usize,
}

impl Contact {
    /// Both together, with the depth of the deeper one; a NaN stays.
    fn with(&self, other: &Self) -> Self {
        let deeper =
            if other.separation < self.separation || other.separation.is_nan() { other } else { self };
        Self { points: self.points + other.points, ..*deeper }
    }
}

/// parry3d's answers for a pair: f32, then f64.
pub(super) fn ask(pair: &PosedPair3) -> [Said; 2] {
    [guarded(|| Some(single::Twins::new(pair)?.said())), guarded(|| Some(double::Twins::new(pair)?.said()))]
}

/// What a call returns; `None` if it panics. Nothing that a panic leaves behind is used again.
pub fn unless_panic<T>(call: impl FnOnce() -> Option<T>) -> Option<T> {
    catch_unwind(AssertUnwindSafe(call)).ok().flatten()
}

/// A peer's answers from a call that may panic.
fn guarded(ask: impl FnOnce() -> Option<Said>) -> Said {
    let ask = || Some(ask().unwrap_or_default());
    unless_panic(ask).unwrap_or(Said { panicked: true, ..Said::default() })
}

macro_rules! peer {
    ($module:ident, $parry:ident, $doc:literal) => {
        #[doc = $doc]
        pub mod $module {
            use super::{Contact, Said, unless_panic};
            use asunder_geometry::{Pose3, Shape3};
            use asunder_scenes::pairs::PosedPair3;
            use glam::{DVec3, Vec3};
            use $parry::math::{Pose, Real, Rotation, Vector};
            use $parry::query::{
                ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher, contact, distance,
                intersection_test,
            };
            use $parry::shape::SharedShape;

            /// Both shapes as this peer's, posed.
            pub struct Twins {
                shapes: [SharedShape; 2],
                poses: [Pose; 2],
            }

            /// Its manifolds of a pair, kept from frame to frame.
            pub type Manifolds = Vec<ContactManifold<(), ()>>;

            impl Twins {
                /// `None` where the peer has no such shape, or rejects it.
                pub fn new(pair: &PosedPair3) -> Option<Self> {
                    Some(Self {
                        shapes: [shape(&pair.shape_a)?, shape(&pair.shape_b)?],
                        poses: [pose(&pair.pose_a), pose(&pair.pose_b)],
                    })
                }

                /// As [`Twins::new`] for many pairs; equal shapes are shared, as in a game. Cost: each shape is
                /// searched among those before it.
                pub fn all(pairs: &[PosedPair3]) -> Vec<Option<Self>> {
                    let mut known: Vec<(&Shape3, Option<SharedShape>)> = Vec::new();
                    let mut find = |ours| {
                        if let Some((_, twin)) = known.iter().find(|(other, _)| *other == ours) {
                            return twin.clone();
                        }
                        let twin = unless_panic(|| shape(ours));
                        known.push((ours, twin.clone()));
                        twin
                    };
                    let twins = pairs.iter().map(|pair| {
                        let shapes = [find(&pair.shape_a)?, find(&pair.shape_b)?];
                        Some(Self { shapes, poses: [pose(&pair.pose_a), pose(&pair.pose_b)] })
                    });
                    twins.collect()
                }

                /// Whether they share a point; `None` where the peer has no such query.
                pub fn overlaps(&self) -> Option<bool> {
                    let ([a, b], [at_a, at_b]) = (&self.shapes, &self.poses);
                    Some(intersection_test(at_a, &*a.0, at_b, &*b.0).ok()?.intersecting)
                }

                #[allow(clippy::unnecessary_cast, reason = "written once for f32 and f64")]
                fn separation(&self) -> Option<f64> {
                    let ([a, b], [at_a, at_b]) = (&self.shapes, &self.poses);
                    let gap = distance(at_a, &*a.0, at_b, &*b.0).ok()?.distance;
                    // A NaN is not zero, and must be seen.
                    if gap != 0.0 {
                        return Some(gap as f64);
                    }
                    // In this order, `contact_support_map_halfspace` of 0.31 forgets to invert the pose.
                    if b.as_halfspace().is_some() || a.as_halfspace().is_some() && b.as_compound().is_some() {
                        return None;
                    }
                    let found = contact(at_a, &*a.0, at_b, &*b.0, 0.0).ok()?;
                    let Some(found) = found else { return Some(0.0) };
                    let sum = found.normal1.x + found.normal1.y + found.normal1.z;
                    Some(if sum.is_nan() { f64::NAN } else { found.dist as f64 })
                }

                /// The contact where they overlap; the inner `None` where they are apart, the outer where the peer has
                /// no such query.
                #[allow(clippy::unnecessary_cast, reason = "written once for f32 and f64")]
                pub fn contact(&self) -> Option<Option<Contact>> {
                    let ([a, b], [at_a, at_b]) = (&self.shapes, &self.poses);
                    let found = contact(at_a, &*a.0, at_b, &*b.0, 0.0).ok()?;
                    Some(found.map(|found| {
                        let n = found.normal1;
                        let normal = DVec3::new(n.x as f64, n.y as f64, n.z as f64);
                        Contact { separation: found.dist as f64, normal, points: 1 }
                    }))
                }

                /// Forgets the last frame but keeps the memory: an empty manifold without a normal counts as never
                /// seen.
                pub fn forget(kept: &mut Manifolds) {
                    for manifold in kept {
                        manifold.points.clear();
                        (manifold.local_n1, manifold.local_n2) = (Vector::ZERO, Vector::ZERO);
                    }
                }

                /// Its contact points at margin 0, given what it kept of the last frame: the separation of the deepest
                /// one, and its manifold's normal in A's axes.
                #[allow(clippy::unnecessary_cast, reason = "written once for f32 and f64")]
                pub fn manifold(&self, kept: &mut Manifolds) -> Option<Option<Contact>> {
                    let ([a, b], [at_a, at_b]) = (&self.shapes, &self.poses);
                    let between = at_a.inv_mul(at_b);
                    DefaultQueryDispatcher
                        .contact_manifolds(&between, &*a.0, &*b.0, 0.0, kept, &mut None)
                        .ok()?;
                    let mut found: Option<Contact> = None;
                    for manifold in kept.iter() {
                        let n = manifold.local_n1;
                        let normal = DVec3::new(n.x as f64, n.y as f64, n.z as f64);
                        for point in &manifold.points {
                            let new = Contact { separation: point.dist as f64, normal, points: 1 };
                            found = Some(found.map_or(new, |known| known.with(&new)));
                        }
                    }
                    Some(found)
                }

                /// Both answers.
                pub(super) fn said(&self) -> Said {
                    Said { overlaps: self.overlaps(), separation: self.separation(), panicked: false }
                }
            }

            fn vector(v: Vec3) -> Vector {
                place(v.as_dvec3())
            }

            #[allow(clippy::unnecessary_cast, reason = "written once for f32 and f64")]
            fn place(v: DVec3) -> Vector {
                Vector::new(v.x as Real, v.y as Real, v.z as Real)
            }

            #[allow(clippy::unnecessary_cast, reason = "written once for f32 and f64")]
            fn pose(pose: &Pose3) -> Pose {
                let q = pose.rotation().to_array().map(f64::from);
                let length = q.iter().map(|c| c * c).sum::<f64>().sqrt();
                let [x, y, z, w] = q.map(|c| (c / length) as Real);
                Pose::from_parts(place(pose.position()), Rotation::from_xyzw(x, y, z, w))
            }

            fn shape(ours: &Shape3) -> Option<SharedShape> {
                let radius = Real::from(ours.radius());
                let points =
                    || -> Vec<Vector> { ours.core().vertices().iter().map(|&v| vector(v)).collect() };
                Some(match ours {
                    Shape3::Sphere(_) => SharedShape::ball(radius),
                    Shape3::Capsule(capsule) => {
                        let [from, to] = capsule.segment().ends().map(vector);
                        SharedShape::capsule(from, to, radius)
                    }
                    Shape3::Cuboid(cuboid) => {
                        let half = vector(cuboid.half_extents());
                        match radius > 0.0 {
                            true => SharedShape::round_cuboid(half.x, half.y, half.z, radius),
                            false => SharedShape::cuboid(half.x, half.y, half.z),
                        }
                    }
                    Shape3::Hull(_) if radius > 0.0 => SharedShape::round_convex_hull(&points(), radius)?,
                    Shape3::Hull(_) => SharedShape::convex_hull(&points())?,
                    Shape3::HalfSpace(half_space) => SharedShape::halfspace(place(half_space.unit_normal())),
                    Shape3::Triangle(triangle) => {
                        let [a, b, c] = triangle.vertices().map(vector);
                        SharedShape::triangle(a, b, c)
                    }
                    Shape3::Segment(segment) => {
                        let [from, to] = segment.ends().map(vector);
                        SharedShape::segment(from, to)
                    }
                    Shape3::Compound(compound) => {
                        let parts = compound.parts().iter();
                        let twins = parts.map(|part| Some((pose(part.pose()), shape(part.shape())?)));
                        SharedShape::compound(twins.collect::<Option<Vec<_>>>()?)
                    }
                    Shape3::TriMesh(mesh) => {
                        let vertices = mesh.vertices().iter().map(|&vertex| vector(vertex)).collect();
                        SharedShape::trimesh(vertices, mesh.triangles().to_vec()).ok()?
                    }
                    // Its cells may be cut along the other diagonal: no twin.
                    Shape3::HeightField(_) => return None,
                })
            }
        }
    };
}

peer!(single, parry3d, "parry3d in f32.");
peer!(double, parry3d_f64, "parry3d in f64.");

#[cfg(test)]
mod tests {
    use super::*;
    use asunder_geometry::{Cuboid, Pose3, Shape3};

    #[test]
    fn both_peers_measure_two_cubes_in_a_gap_and_in_overlap() {
        let cube = Shape3::from(Cuboid::from_half_extents(glam::Vec3::splat(0.5)).unwrap());
        for (x, separation) in [(1.5, 0.5), (0.75, -0.25)] {
            let pose_b = Pose3::at([x, 0.0, 0.0]).unwrap();
            let pair =
                PosedPair3 { shape_a: cube.clone(), pose_a: Pose3::IDENTITY, shape_b: cube.clone(), pose_b };
            for said in ask(&pair) {
                assert_eq!(said.overlaps, Some(separation < 0.0), "{said:?}");
                assert!((said.separation.unwrap() - separation).abs() < 1e-6, "{said:?}");
                assert!(!said.panicked);
            }
        }
    }

    #[test]
    fn a_panic_is_an_answer() {
        let said = guarded(|| panic!("as a peer may"));
        assert!(said.panicked && said.overlaps.is_none() && said.separation.is_none());
    }
}
