//! The shapes of a world; those that several bodies share are stored once.
//!
//! Hulls, polygons, compounds and ground keep their data behind a counted pointer, and clones share it. Bodies refer to
//! such data by its place in a table, and store any other shape themselves. A compound's parts may share data with
//! other bodies, too.

use super::Snapshot;
use super::digest::digest;
use super::error::SnapshotError;
use crate::space::{Plane, Space, Volume};
use crate::world::World;
use asunder_geometry::{
    Chain, Compound2, Compound3, HeightField, Hull, Polygon, Pose2, Pose3, RadiusError, Shape2, Shape3,
    TriMesh,
};
use core::fmt::{Debug, Display};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What is stored as it is.
pub trait Plain: Clone + PartialEq + Debug + Serialize + DeserializeOwned {}
impl<T: Clone + PartialEq + Debug + Serialize + DeserializeOwned> Plain for T {}

/// A compound's parts.
type PosedShapes<'a, S> = Vec<(<S as Space>::Pose, &'a <S as Space>::Shape)>;

/// A dimension whose worlds can be saved: both. Here is what differs between the shapes of the two.
pub trait Saved:
    Space<
        Key: Plain,
        Pose: Plain,
        Shape: Plain,
        Manifold: Plain,
        Persistent: Plain,
        Motion: Plain,
        Impact: Plain,
    > + Clone
    + PartialEq
    + Debug
{
    /// A snapshot of a world; its definitions are not generic, for the reason of [`Space::advance`].
    #[doc(hidden)]
    fn save(world: &World<Self>) -> Snapshot<Self>;

    /// The world of a snapshot.
    #[doc(hidden)]
    fn restore(snapshot: &Snapshot<Self>) -> Result<World<Self>, SnapshotError>;

    /// A hull or a polygon.
    #[doc(hidden)]
    type Polytope: Plain;

    /// Ground.
    #[doc(hidden)]
    type Ground: Plain;

    /// Serde's name of the shape that is only a radius.
    #[doc(hidden)]
    const BALL: &'static str;

    /// The polytope of a shape, without rounding; its address, and its rounding.
    #[doc(hidden)]
    fn polytope(shape: &Self::Shape) -> Option<(Self::Polytope, usize, f32)>;

    /// The polytope as a shape, with rounding.
    #[doc(hidden)]
    fn rounded(polytope: &Self::Polytope, radius: f32) -> Result<Self::Shape, RadiusError>;

    /// The address of a compound, and its parts.
    #[doc(hidden)]
    fn parts(shape: &Self::Shape) -> Option<(usize, PosedShapes<'_, Self>)>;

    /// A compound of parts.
    #[doc(hidden)]
    fn compound(parts: Vec<(Self::Pose, Self::Shape)>) -> Result<Self::Shape, impl Display>;

    /// Ground, and its address.
    #[doc(hidden)]
    fn ground(shape: &Self::Shape) -> Option<(Self::Ground, usize)>;

    /// Ground as a shape.
    #[doc(hidden)]
    fn grounded(ground: &Self::Ground) -> Self::Shape;

    /// Whether a manifold has points, finite numbers and a unit normal.
    #[doc(hidden)]
    fn is_sound(manifold: &Self::Manifold) -> bool;

    /// Whether what is kept of a manifold is sound, and its other numbers are finite.
    #[doc(hidden)]
    fn is_lasting(persistent: &Self::Persistent) -> bool;

    /// The fraction of the motion at which it happens.
    #[doc(hidden)]
    fn fraction(impact: &Self::Impact) -> f64;

    /// Whether an impact is in its motion, and has finite numbers and a unit normal.
    #[doc(hidden)]
    fn is_real(impact: &Self::Impact) -> bool;
}

/// The shape of a body or of a compound's part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Shape")]
pub(super) enum ShapeRef<Shape> {
    Own(Shape),
    Polytope { index: u32, radius: f32 },
    Compound { index: u32 },
    Ground { index: u32 },
}

/// Shared shapes, in the order in which the bodies name them first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(bound = "", deny_unknown_fields)]
pub(super) struct Table<S: Saved> {
    polytopes: Vec<S::Polytope>,
    compounds: Vec<Vec<PartForm<S>>>,
    ground: Vec<S::Ground>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Part", bound = "", deny_unknown_fields)]
struct PartForm<S: Saved> {
    pose: S::Pose,
    shape: ShapeRef<S::Shape>,
}

/// A table in the making. Addresses, which differ from run to run, only serve to look up what has been seen. Equal data
/// at two addresses get one place, too, so that a snapshot does not depend on what happens to be shared: a loaded game
/// makes its new bodies of shapes of its own.
pub(super) struct Collected<S: Saved> {
    pub(super) table: Table<S>,
    polytopes: Seen,
    compounds: Seen,
    ground: Seen,
}

/// Places in a list, by address and by digest.
#[derive(Default)]
struct Seen {
    by_address: BTreeMap<usize, u32>,
    by_digest: BTreeMap<u64, Vec<u32>>,
}

impl Seen {
    /// The place of an item in the list; a new item is appended.
    fn place<T: PartialEq + Serialize>(&mut self, address: usize, list: &mut Vec<T>, item: T) -> u32 {
        let alike = self.by_digest.entry(digest(&item)).or_default();
        let known = alike.iter().copied().find(|&place| list.get(place as usize) == Some(&item));
        let place = known.unwrap_or_else(|| {
            alike.push(list.len() as u32);
            list.push(item);
            list.len() as u32 - 1
        });
        self.by_address.insert(address, place);
        place
    }
}

impl<S: Saved> Collected<S> {
    pub(super) fn new() -> Self {
        let table = Table { polytopes: Vec::new(), compounds: Vec::new(), ground: Vec::new() };
        Self { table, polytopes: Seen::default(), compounds: Seen::default(), ground: Seen::default() }
    }

    /// How a body refers to its shape.
    pub(super) fn name(&mut self, shape: &S::Shape) -> ShapeRef<S::Shape> {
        if let Some((polytope, address, radius)) = S::polytope(shape) {
            let known = self.polytopes.by_address.get(&address).copied();
            let index =
                known.unwrap_or_else(|| self.polytopes.place(address, &mut self.table.polytopes, polytope));
            return ShapeRef::Polytope { index, radius };
        }
        if let Some((ground, address)) = S::ground(shape) {
            let known = self.ground.by_address.get(&address).copied();
            let index = known.unwrap_or_else(|| self.ground.place(address, &mut self.table.ground, ground));
            return ShapeRef::Ground { index };
        }
        let Some((address, parts)) = S::parts(shape) else { return ShapeRef::Own(shape.clone()) };
        if let Some(&index) = self.compounds.by_address.get(&address) {
            return ShapeRef::Compound { index };
        }
        let parts: Vec<PartForm<S>> =
            parts.into_iter().map(|(pose, shape)| PartForm { pose, shape: self.name(shape) }).collect();
        ShapeRef::Compound { index: self.compounds.place(address, &mut self.table.compounds, parts) }
    }
}

/// The restored table: compounds are made once, and handed out as clones.
pub(super) struct Revived<'a, S: Saved> {
    polytopes: &'a [S::Polytope],
    compounds: Vec<S::Shape>,
    ground: &'a [S::Ground],
}

impl<'a, S: Saved> Revived<'a, S> {
    pub(super) fn of(table: &'a Table<S>) -> Result<Self, SnapshotError> {
        let mut revived = Self { polytopes: &table.polytopes, compounds: Vec::new(), ground: &table.ground };
        for (index, parts) in table.compounds.iter().enumerate() {
            let refused = |reason: String| SnapshotError::Shape { index, reason };
            let part = |part: &PartForm<S>| Ok((part.pose, revived.shape(&part.shape)?));
            let parts = parts.iter().map(part).collect::<Result<_, String>>().map_err(refused)?;
            let compound = S::compound(parts).map_err(|error| refused(error.to_string()))?;
            revived.compounds.push(compound);
        }
        Ok(revived)
    }

    /// The shape that a body refers to, or what is wrong with the reference.
    pub(super) fn shape(&self, name: &ShapeRef<S::Shape>) -> Result<S::Shape, String> {
        match name {
            ShapeRef::Own(shape) => Ok(shape.clone()),
            ShapeRef::Polytope { index, radius } => {
                let polytope = self.polytopes.get(*index as usize).ok_or_else(|| missing(*index))?;
                S::rounded(polytope, *radius).map_err(|error| error.to_string())
            }
            ShapeRef::Compound { index } => {
                self.compounds.get(*index as usize).cloned().ok_or_else(|| missing(*index))
            }
            ShapeRef::Ground { index } => {
                self.ground.get(*index as usize).map(S::grounded).ok_or_else(|| missing(*index))
            }
        }
    }
}

/// Ground in space.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum SpaceGround {
    Mesh(TriMesh),
    Field(HeightField),
}

/// The address of data that one-sided and two-sided ground may share, with the side in its last bit, which alignment
/// leaves free.
const fn with_side(address: usize, is_one_sided: bool) -> usize {
    address | is_one_sided as usize
}

fn missing(index: u32) -> String {
    format!("there is no shape {index}")
}

impl Saved for Plane {
    type Polytope = Polygon;
    type Ground = Chain;

    const BALL: &'static str = "Circle";

    fn save(world: &World<Self>) -> Snapshot<Self> {
        super::save(world)
    }

    fn restore(snapshot: &Snapshot<Self>) -> Result<World<Self>, SnapshotError> {
        super::restore(snapshot)
    }

    fn polytope(shape: &Shape2) -> Option<(Polygon, usize, f32)> {
        let Shape2::Polygon(polygon) = shape else { return None };
        let sharp = polygon.clone().rounded(0.0).ok()?;
        Some((sharp, polygon.shared_address(), polygon.radius()))
    }

    fn rounded(polygon: &Polygon, radius: f32) -> Result<Shape2, RadiusError> {
        polygon.clone().rounded(radius).map(Shape2::from)
    }

    fn parts(shape: &Shape2) -> Option<(usize, PosedShapes<'_, Self>)> {
        let Shape2::Compound(compound) = shape else { return None };
        let parts = compound.parts().iter().map(|part| (*part.pose(), part.shape())).collect();
        Some((compound.shared_address(), parts))
    }

    fn compound(parts: Vec<(Pose2, Shape2)>) -> Result<Shape2, impl Display> {
        Compound2::new(parts).map(Shape2::from)
    }

    fn ground(shape: &Shape2) -> Option<(Chain, usize)> {
        let Shape2::Chain(chain) = shape else { return None };
        Some((chain.clone(), with_side(chain.shared_address(), chain.is_one_sided())))
    }

    fn grounded(chain: &Chain) -> Shape2 {
        chain.clone().into()
    }

    fn is_sound(manifold: &Self::Manifold) -> bool {
        let points = manifold.points.iter();
        let are_finite = |point: &asunder_narrow::ContactPoint2| {
            point.separation.is_finite() && point.anchor_a.is_finite() && point.anchor_b.is_finite()
        };
        is_number(manifold.separation, manifold.error, manifold.normal.as_dvec2().length_squared())
            && !manifold.points.is_empty()
            && points.into_iter().all(are_finite)
    }

    fn is_lasting(persistent: &Self::Persistent) -> bool {
        Self::is_sound(persistent.manifold()) && persistent.is_sound()
    }

    fn fraction(impact: &Self::Impact) -> f64 {
        impact.fraction
    }

    fn is_real(impact: &Self::Impact) -> bool {
        (0.0..=1.0).contains(&impact.fraction)
            && is_number(0.0, impact.error, impact.normal.as_dvec2().length_squared())
            && impact.anchor_a.is_finite()
            && impact.anchor_b.is_finite()
    }
}

impl Saved for Volume {
    type Polytope = Hull;
    type Ground = SpaceGround;

    const BALL: &'static str = "Sphere";

    fn save(world: &World<Self>) -> Snapshot<Self> {
        super::save(world)
    }

    fn restore(snapshot: &Snapshot<Self>) -> Result<World<Self>, SnapshotError> {
        super::restore(snapshot)
    }

    fn polytope(shape: &Shape3) -> Option<(Hull, usize, f32)> {
        let Shape3::Hull(hull) = shape else { return None };
        let sharp = hull.clone().rounded(0.0).ok()?;
        Some((sharp, hull.shared_address(), hull.radius()))
    }

    fn rounded(hull: &Hull, radius: f32) -> Result<Shape3, RadiusError> {
        hull.clone().rounded(radius).map(Shape3::from)
    }

    fn parts(shape: &Shape3) -> Option<(usize, PosedShapes<'_, Self>)> {
        let Shape3::Compound(compound) = shape else { return None };
        let parts = compound.parts().iter().map(|part| (*part.pose(), part.shape())).collect();
        Some((compound.shared_address(), parts))
    }

    fn compound(parts: Vec<(Pose3, Shape3)>) -> Result<Shape3, impl Display> {
        Compound3::new(parts).map(Shape3::from)
    }

    fn ground(shape: &Shape3) -> Option<(SpaceGround, usize)> {
        Some(match shape {
            Shape3::TriMesh(mesh) => {
                (SpaceGround::Mesh(mesh.clone()), with_side(mesh.shared_address(), mesh.is_one_sided()))
            }
            Shape3::HeightField(field) => {
                (SpaceGround::Field(field.clone()), with_side(field.shared_address(), field.is_one_sided()))
            }
            _ => return None,
        })
    }

    fn grounded(ground: &SpaceGround) -> Shape3 {
        match ground {
            SpaceGround::Mesh(mesh) => mesh.clone().into(),
            SpaceGround::Field(field) => field.clone().into(),
        }
    }

    fn is_sound(manifold: &Self::Manifold) -> bool {
        let points = manifold.points.iter();
        let are_finite = |point: &asunder_narrow::ContactPoint3| {
            point.separation.is_finite() && point.anchor_a.is_finite() && point.anchor_b.is_finite()
        };
        is_number(manifold.separation, manifold.error, manifold.normal.as_dvec3().length_squared())
            && !manifold.points.is_empty()
            && points.into_iter().all(are_finite)
    }

    fn is_lasting(persistent: &Self::Persistent) -> bool {
        persistent.manifolds().all(|manifold| Self::is_sound(&manifold)) && persistent.is_sound()
    }

    fn fraction(impact: &Self::Impact) -> f64 {
        impact.fraction
    }

    fn is_real(impact: &Self::Impact) -> bool {
        (0.0..=1.0).contains(&impact.fraction)
            && is_number(0.0, impact.error, impact.normal.as_dvec3().length_squared())
            && impact.anchor_a.is_finite()
            && impact.anchor_b.is_finite()
    }
}

/// Whether a separation is finite, its error one, and its normal of unit length up to the rounding of f32.
fn is_number(separation: f32, error: f32, squared_length: f64) -> bool {
    separation.is_finite()
        && error.is_finite()
        && error >= 0.0
        && (squared_length - 1.0).abs() <= 8.0 * f64::from(f32::EPSILON)
}
