//! What is cast through an index: a ray, or a box.

use asunder_geometry::{
    Aabb2, Aabb3, Bounds, Ray2, Ray3,
    glam::{Vec2, Vec3},
};

/// A ray, or a box that is moved along a line, prepared for tests against many boxes.
///
/// Distances are in lengths of the direction, as with the ray it is made from. An empty box, or one moved in a
/// direction that is not finite, meets nothing; with direction zero it meets all that it overlaps, at distance 0.
///
/// ```
/// use asunder_broad::{Cast, Index};
/// use asunder_geometry::{Aabb3, Ray3, glam::Vec3};
/// let mut index = Index::new();
/// index.build(&[2.0, 4.0].map(|x| Aabb3::new(Vec3::new(x, 0.0, 0.0), Vec3::new(x + 1.0, 1.0, 1.0))));
///
/// let mut found = vec![];
/// index.crossed(&Cast::from(Ray3::new([0.0, 0.5, 0.5], Vec3::X)?), 3.5, &mut found);
/// assert!(found.len() == 1 && found[0].number == 0);
/// assert!(found[0].distance <= 2.0 && found[0].distance > 1.99999, "never too far");
///
/// let unit = Aabb3::new(Vec3::ZERO, Vec3::ONE);
/// index.crossed(&Cast::of_box3(&unit, Vec3::X), 3.5, &mut found);
/// assert_eq!(found.len(), 2);
/// # Ok::<(), asunder_geometry::RayError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Cast {
    /// On each axis, which side of a box is met first, and which last, as rows of a node.
    pub(crate) near: [usize; 3],
    pub(crate) far: [usize; 3],
    /// The coordinates from which these are measured.
    pub(crate) from_near: [f32; 3],
    pub(crate) from_far: [f32; 3],
    /// Distance per metre; rounded down and up by more than all later rounding can add up to.
    pub(crate) per_near: [f32; 3],
    pub(crate) per_far: [f32; 3],
    /// Lengths of the direction per internal unit of distance, a power of two.
    unit: f64,
}

/// Relative rounding error allowed for between a corner and a distance: three roundings to f32 of at most 2^-24 each.
const LOST: f64 = 1.0 / 4_194_304.0;

impl Cast {
    /// A box in the plane, moved by `along` per unit of distance.
    pub fn of_box2(bounds: &Aabb2, along: Vec2) -> Self {
        Self::of_box(bounds, [along.x, along.y, 0.0])
    }

    /// A box in space, moved by `along` per unit of distance.
    pub fn of_box3(bounds: &Aabb3, along: Vec3) -> Self {
        Self::of_box(bounds, along.to_array())
    }

    fn of_box(bounds: &impl Bounds, along: [f32; 3]) -> Self {
        if bounds.is_valid() { Self::new(bounds.corners(), along) } else { Self::NOWHERE }
    }

    /// On an axis, a moved box meets another from when their near sides touch until their far sides do. A ray is the
    /// smallest f32 box around its origin.
    fn new((low, high): ([f32; 3], [f32; 3]), along: [f32; 3]) -> Self {
        let longest =
            along.iter().fold(0.0, |most: f32, part| if part.abs() > most { part.abs() } else { most });
        if !along.iter().all(|part| part.is_finite()) {
            return Self::NOWHERE;
        }
        // The power of two below the longest component: internally, directions have a length of about 1, and nothing
        // overflows early.
        let unit =
            if longest > 0.0 { f64::from_bits(f64::from(longest).to_bits() & (0x7ff << 52)) } else { 1.0 };
        let mut cast = Self { unit: 1.0 / unit, from_near: high, from_far: low, ..Self::NOWHERE };
        for axis in 0..3 {
            let per = unit / f64::from(along[axis].abs());
            let is_backward = along[axis] < 0.0;
            cast.near[axis] = if is_backward { axis + 3 } else { axis };
            cast.far[axis] = if is_backward { axis } else { axis + 3 };
            let sign = if is_backward { -1.0 } else { 1.0 };
            if is_backward {
                (cast.from_near[axis], cast.from_far[axis]) = (low[axis], high[axis]);
            }
            // Without motion along this axis: met after an infinite distance, unless it is met at once.
            let most = if per < f64::INFINITY { f32::MAX } else { f32::INFINITY };
            cast.per_near[axis] = sign * ((per * (1.0 - LOST)) as f32).min(most);
            cast.per_far[axis] = sign * (per * (1.0 + LOST)) as f32;
        }
        cast
    }

    /// Meets nothing: its limit is NaN.
    const NOWHERE: Self = Self {
        near: [0, 1, 2],
        far: [3, 4, 5],
        from_near: [0.0; 3],
        from_far: [0.0; 3],
        per_near: [0.0; 3],
        per_far: [0.0; 3],
        unit: f64::NAN,
    };

    /// Converts an internal distance to the caller's.
    #[inline(always)]
    pub(crate) fn told(&self, within: f32) -> f64 {
        f64::from(within) * self.unit
    }

    /// The greatest internal distance within a limit; negative if there is none.
    #[inline(always)]
    pub(crate) fn within(&self, limit: f64) -> f32 {
        let limit = limit / self.unit * (1.0 + LOST);
        if limit >= 0.0 { (limit as f32).min(f32::MAX) } else { -1.0 }
    }
}

impl From<Ray2> for Cast {
    fn from(ray: Ray2) -> Self {
        Self::new(around([ray.origin().x, ray.origin().y, 0.0]), [ray.direction().x, ray.direction().y, 0.0])
    }
}

impl From<Ray3> for Cast {
    fn from(ray: Ray3) -> Self {
        Self::new(around(ray.origin().to_array()), ray.direction().to_array())
    }
}

/// The smallest f32 box that holds a point.
fn around(point: [f64; 3]) -> ([f32; 3], [f32; 3]) {
    let nearest = point.map(|part| part as f32);
    let (mut low, mut high) = (nearest, nearest);
    for axis in 0..3 {
        let rounded = f64::from(nearest[axis]);
        if rounded > point[axis] {
            low[axis] = nearest[axis].next_down();
        }
        if rounded < point[axis] {
            high[axis] = nearest[axis].next_up();
        }
    }
    (low, high)
}
