//! Ground and bodies for these tests.

use asunder_geometry::glam::{DVec3, Quat, Vec3};
use asunder_geometry::{
    Capsule3, Compound3, Cuboid, Hull, Pose3, Segment3, Shape3, Sphere, TriMesh, Triangle3,
};
use oorandom::Rand64;

/// A seeded generator: the same numbers in every run.
pub(super) struct Random(Rand64);

impl Random {
    pub(super) fn new(seed: u128) -> Self {
        Self(Rand64::new(seed))
    }

    /// From -1 to 1.
    pub(super) fn signed(&mut self) -> f64 {
        2.0 * self.0.rand_float() - 1.0
    }

    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.rand_float()
    }

    pub(super) fn below(&mut self, count: usize) -> usize {
        self.0.rand_range(0..count as u64) as usize
    }

    pub(super) fn vector(&mut self) -> DVec3 {
        DVec3::new(self.signed(), self.signed(), self.signed())
    }

    pub(super) fn rotation(&mut self) -> Quat {
        let [x, y, z, w] = [0; 4].map(|_| self.signed() as f32);
        Quat::from_xyzw(x, y, z, w + if x == 0.0 && y == 0.0 && z == 0.0 && w == 0.0 { 1.0 } else { 0.0 })
    }
}

/// Number of kinds of body, all about a metre across.
pub(super) const BODIES: usize = 8;

/// The body of a kind.
pub(super) fn body(kind: usize) -> Shape3 {
    let half = Vec3::new(0.5, 0.25, 0.35);
    match kind {
        0 => Cuboid::from_half_extents(half).unwrap().into(),
        1 => Cuboid::from_half_extents(half).unwrap().rounded(0.1).unwrap().into(),
        2 => hull().into(),
        3 => hull().rounded(0.08).unwrap().into(),
        4 => Sphere::new(0.4).unwrap().into(),
        5 => Capsule3::new(Vec3::new(-0.4, 0.0, 0.0), Vec3::new(0.4, 0.0, 0.0), 0.25).unwrap().into(),
        6 => {
            let wheel: Shape3 = Sphere::new(0.3).unwrap().into();
            let block: Shape3 = Cuboid::from_half_extents(Vec3::new(0.3, 0.3, 0.3)).unwrap().into();
            Compound3::new([
                (Pose3::at([0.5, 0.0, 0.0]).unwrap(), wheel),
                (Pose3::at([-0.4, 0.0, 0.1]).unwrap(), block),
            ])
            .unwrap()
            .into()
        }
        _ => Triangle3::new(Vec3::new(-0.5, 0.0, 0.0), Vec3::new(0.5, 0.0, 0.1), Vec3::new(0.0, 0.0, 0.6))
            .unwrap()
            .into(),
    }
}

/// A segment, which has no interior and no radius.
pub(super) fn stick() -> Shape3 {
    Segment3::new(Vec3::new(-0.4, -0.1, 0.0), Vec3::new(0.4, 0.1, 0.2)).unwrap().into()
}

/// A hexagonal prism that stands on its base, with a slightly skewed top.
fn hull() -> Hull {
    let base = [[0.5, 0.0], [0.25, 0.4], [-0.25, 0.4], [-0.5, 0.0], [-0.25, -0.4], [0.25, -0.4]];
    let points: Vec<Vec3> = base
        .iter()
        .flat_map(|&[x, z]| [Vec3::new(x, -0.25, z), Vec3::new(0.7 * x + 0.1, 0.3, 0.7 * z)])
        .collect();
    Hull::from_points(&points).unwrap()
}

/// How far a body in its rest pose reaches below its position.
pub(super) fn rest_height(kind: usize) -> f64 {
    [0.25, 0.35, 0.25, 0.33, 0.4, 0.25, 0.3, 0.0][kind]
}

/// A grid of squares placed by `place`, each cut in two; the diagonals alternate from square to square.
pub(super) fn grid(
    [wide, long]: [usize; 2],
    step: f32,
    place: impl Fn(usize, usize) -> Vec3,
) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let middle = [wide, long].map(|count| count as f32 * step * 0.5);
    let corner = |x: usize, z: usize| {
        Vec3::new(x as f32 * step - middle[0], 0.0, z as f32 * step - middle[1]) + place(x, z)
    };
    let vertices =
        (0..=long).flat_map(|z| (0..=wide).map(move |x| (x, z))).map(|(x, z)| corner(x, z)).collect();
    let number = |x: usize, z: usize| (z * (wide + 1) + x) as u32;
    let mut triangles = Vec::new();
    for z in 0..long {
        for x in 0..wide {
            let [a, b, c, d] = [number(x, z), number(x + 1, z), number(x, z + 1), number(x + 1, z + 1)];
            // Counter-clockwise, seen from above.
            if (x + z) % 2 == 0 {
                triangles.extend([[a, c, b], [b, c, d]]);
            } else {
                triangles.extend([[a, c, d], [a, d, b]]);
            }
        }
    }
    (vertices, triangles)
}

/// Ways to cut the plane y = 0.
pub(super) const FLATS: usize = 5;

/// The plane y = 0, cut into triangles in one of the ways.
pub(super) fn flat(way: usize) -> TriMesh {
    let mut random = Random::new(5);
    match way {
        // A regular grid.
        0 => mesh(grid([16; 2], 0.5, |_, _| Vec3::ZERO)),
        // A strip of two rows.
        1 => {
            let (vertices, triangles) = grid([16, 2], 0.5, |_, _| Vec3::ZERO);
            let wide: Vec<Vec3> = vertices.iter().map(|v| Vec3::new(v.x, 0.0, v.z * 8.0)).collect();
            mesh((wide, triangles))
        }
        // An irregular one.
        2 => {
            let shifts: Vec<Vec3> = (0..17 * 17)
                .map(|_| Vec3::new(random.signed() as f32, 0.0, random.signed() as f32) * 0.2)
                .collect();
            mesh(grid([16; 2], 0.5, |x, z| shifts[z * 17 + x]))
        }
        // Triangles a thousand times as long as wide.
        3 => {
            let (vertices, triangles) = grid([2, 320], 0.5, |_, _| Vec3::ZERO);
            let thin: Vec<Vec3> = vertices.iter().map(|v| Vec3::new(v.x * 40.0, 0.0, v.z * 0.04)).collect();
            mesh((thin, triangles))
        }
        // Each triangle with its own vertices.
        _ => {
            let (vertices, triangles) = grid([16; 2], 0.5, |_, _| Vec3::ZERO);
            let own: Vec<Vec3> =
                triangles.iter().flat_map(|corners| corners.map(|v| vertices[v as usize])).collect();
            let numbers = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
            mesh((own, numbers))
        }
    }
}

pub(super) fn mesh((vertices, triangles): (Vec<Vec3>, Vec<[u32; 3]>)) -> TriMesh {
    TriMesh::new(vertices, triangles).unwrap()
}

/// The same mesh with its vertices rotated and rounded to f32, as a modelling program would.
pub(super) fn baked(mesh: &TriMesh, turn: Quat, shift: Vec3) -> TriMesh {
    let basis = Pose3::new(DVec3::ZERO, turn).unwrap();
    let vertices: Vec<Vec3> =
        mesh.vertices().iter().map(|v| (basis.turn(v.as_dvec3())).as_vec3() + shift).collect();
    let baked = TriMesh::new(vertices, mesh.triangles().to_vec()).unwrap();
    assert_eq!(baked.dropped(), Default::default());
    baked
}

/// Whether a triangle of one-sided ground faces a part with this centre, in the ground's axes; `None` where rounding
/// would decide.
pub(super) fn sees(triangle: &Triangle3, center: DVec3) -> Option<bool> {
    let [a, b, c] = triangle.vertices().map(|v| v.as_dvec3());
    let normal = (b - a).cross(c - a).normalize();
    let height = normal.dot(center - a);
    (height.abs() > 1e-9).then_some(height > 0.0)
}
