//! Scaled shapes in the plane.

use super::{ScaleError, all_scaled, check, scaled_normal, scaled_radius};
use crate::chain::Chain;
use crate::circle::Circle;
use crate::compound::{Compound2, Part2};
use crate::half_space::HalfPlane;
use crate::polygon::Polygon;
use crate::pose2::{Pose2, Rotation2};
use crate::rect::Rect;
use crate::segment::{Capsule2, Segment2};
use crate::shape::Shape2;
use glam::Vec2;

impl Shape2 {
    /// The shape with every local point multiplied by the factors: `Vec2::splat(1.0 / 32.0)` converts pixels to metres
    /// at 32 pixels per metre; negative factors mirror. The result is a new shape that shares no data with the old one.
    ///
    /// Vertices and edges keep their numbers unless the factors mirror. A mirrored polygon is still counter-clockwise,
    /// and a mirrored chain keeps its front, so both are numbered in reverse; corners of rectangles are renumbered.
    /// Rectangles that are rotated in a compound become polygons if the factors differ. Vertices of a chain that come
    /// too close are dropped, as in [`Chain::open`]. Cost: that of making the shape.
    ///
    /// ```
    /// use asunder::{Chain, Rect, Shape2, glam::Vec2};
    /// let sprite = Shape2::from(Rect::from_half_extents(Vec2::new(8.0, 16.0))?);
    /// let (player, flipped) = (sprite.scaled(Vec2::splat(1.0 / 32.0))?, sprite.scaled(Vec2::new(-1.0, 1.0))?);
    /// assert!(player.contains(Vec2::new(0.25, 0.5)) && flipped == sprite);
    ///
    /// let level = Shape2::from(Chain::open([(4.0, 0.0), (0.0, 0.0), (0.0, 3.0)].map(Vec2::from))?.one_sided());
    /// assert!(level.scaled(Vec2::new(-1.0, 1.0))?.contains(Vec2::new(-4.0, 0.0)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A factor that is zero or not finite; a round shape or a rounding with factors that differ in magnitude; a result
    /// that is out of range or has lost a dimension.
    pub fn scaled(&self, factors: Vec2) -> Result<Self, ScaleError> {
        check(&factors.to_array())?;
        match self {
            Self::Compound(compound) => scaled_compound(compound, factors),
            Self::HalfPlane(half_plane) => {
                let normal = scaled_normal(half_plane.normal().to_array(), factors.to_array());
                Ok(HalfPlane::new(Vec2::from_array(normal))?.into())
            }
            Self::Chain(chain) => Ok(scaled_chain(chain, factors)?.into()),
            Self::Rect(rect) => {
                let radius = scaled_radius(rect.radius(), &factors.to_array())?;
                Ok(Rect::from_half_extents(rect.half_extents() * factors.abs())?.rounded(radius)?.into())
            }
            _ => moved(self, |vertex| vertex * factors, factors),
        }
    }
}

/// Whether the factors reverse the orientation.
fn do_mirror(factors: Vec2) -> bool {
    (factors.x < 0.0) != (factors.y < 0.0)
}

/// The convex shape with its vertices moved and its radius scaled.
fn moved(shape: &Shape2, place: impl Fn(Vec2) -> Vec2, factors: Vec2) -> Result<Shape2, ScaleError> {
    let radius = scaled_radius(shape.radius(), &factors.to_array())?;
    Ok(match shape {
        // A point, whose radius `Circle::new` would reject.
        Shape2::Circle(_) if radius == 0.0 => shape.clone(),
        Shape2::Circle(_) => Circle::new(radius)?.into(),
        Shape2::Capsule(capsule) => {
            let [from, to] = capsule.segment().ends().map(place);
            Capsule2::new(from, to, radius)?.into()
        }
        Shape2::Segment(segment) => {
            let [from, to] = segment.ends().map(place);
            Segment2::new(from, to)?.into()
        }
        // A polygon, or a rectangle that is rotated in a compound. Nothing else comes here.
        _ => {
            let mut outline: Vec<Vec2> =
                shape.core().vertices().iter().map(|&vertex| place(vertex)).collect();
            if do_mirror(factors) {
                outline[1..].reverse();
            }
            // Rounding may have pushed a vertex inside the hull of the others, by less than it moves any vertex: then
            // the hull is the shape.
            let new = Polygon::new(&outline).or_else(|_| Polygon::hull_of(&outline))?;
            let error = if let Shape2::Polygon(polygon) = shape { polygon.error() } else { 0.0 };
            let error = f64::from(error) * f64::from(factors.abs().max_element());
            new.left_out(error).rounded(radius)?.into()
        }
    })
}

fn scaled_compound(compound: &Compound2, factors: Vec2) -> Result<Shape2, ScaleError> {
    let are_equal = factors.x == factors.y;
    let scaled = |part: &Part2| -> Result<(Pose2, Shape2), ScaleError> {
        let (pose, shape) = (part.pose(), part.shape());
        let position = pose.position() * factors.as_dvec2();
        if are_equal || pose.rotation() == Rotation2::IDENTITY {
            return Ok((Pose2::new(position, pose.rotation())?, shape.scaled(factors)?));
        }
        let place = |vertex: Vec2| -> Vec2 { (pose.turn(vertex.as_dvec2()) * factors.as_dvec2()).as_vec2() };
        Ok((Pose2::at(position)?, moved(shape, place, factors)?))
    };
    Ok(Compound2::new(all_scaled(compound.parts(), scaled)?)?.into())
}

fn scaled_chain(chain: &Chain, factors: Vec2) -> Result<Chain, ScaleError> {
    let mut vertices: Vec<Vec2> = chain.vertices().iter().map(|&vertex| vertex * factors).collect();
    if do_mirror(factors) {
        vertices.reverse();
    }
    let new = if chain.is_closed() { Chain::closed(vertices)? } else { Chain::open(vertices)? };
    Ok(if chain.is_one_sided() { new.one_sided() } else { new })
}
