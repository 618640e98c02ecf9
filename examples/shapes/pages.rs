//! One small picture for the documentation of each shape: the sharp shape, and beside it the rounded one.

use crate::camera::{Camera, joined};
use crate::canvas::{Anchor, Canvas, Paint};
use crate::flat::Flat;
use crate::kinds::{arch2, arch3, gem, hills, pentagon, stairs, triangle};
use crate::order::{Body, far_to_near, far_to_near_triangles, parts2, parts3, triangles};
use crate::solid::Solid;
use crate::tint::{CARD, COOL, INK, Tint, WARM};
use asunder::glam::{DVec2, DVec3, Vec2, Vec3};
use asunder::{
    Capsule2, Capsule3, Chain, ChainError, Circle, Cuboid, HalfPlane, HalfSpace, Pose2, Pose3, Rect,
    Segment2, Segment3, Shape2, Shape3, Sphere,
};
use std::error::Error;

/// The size of a card in pixels, and the gap around it.
const CARD_SIZE: DVec2 = DVec2::new(220.0, 190.0);
const GAP: f64 = 10.0;
/// Pixels that a shape may fill.
const ROOM: DVec2 = DVec2::new(190.0, 150.0);
/// Pixels a metre, unless the shape is too large for its card.
const SCALE: f64 = 140.0;

/// A picture: the file's name, and its shapes with their captions.
struct Page<S> {
    name: &'static str,
    shapes: Vec<(&'static str, S)>,
}

/// All pictures: (name of the file, its text).
pub(crate) fn pages() -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let solids = solid_pages()?.into_iter().map(|page| (format!("{}.svg", page.name), draw_solids(&page)));
    let flats = flat_pages()?.into_iter().map(|page| (format!("{}.svg", page.name), draw_flats(&page)));
    Ok(solids.chain(flats).collect())
}

fn solid_pages() -> Result<Vec<Page<Shape3>>, Box<dyn Error>> {
    let cuboid = Cuboid::from_half_extents(Vec3::new(0.36, 0.22, 0.28))?;
    let page = |name, shapes| Page { name, shapes };
    Ok(vec![
        page("sphere", vec![("Sphere", Sphere::new(0.42)?.into())]),
        page(
            "capsule3",
            vec![(
                "Capsule3",
                Capsule3::new(Vec3::new(-0.3, -0.2, 0.0), Vec3::new(0.3, 0.2, 0.0), 0.22)?.into(),
            )],
        ),
        page("cuboid", vec![("Cuboid", cuboid.into()), ("Cuboid, rounded", cuboid.rounded(0.12)?.into())]),
        page("hull", vec![("Hull", gem(0.85)?.into()), ("Hull, rounded", gem(0.85)?.rounded(0.12)?.into())]),
        page("half_space", vec![("HalfSpace", HalfSpace::new(Vec3::Y)?.into())]),
        page("triangle3", vec![("Triangle3", triangle()?.into())]),
        page(
            "segment3",
            vec![(
                "Segment3",
                Segment3::new(Vec3::new(-0.4, -0.25, 0.1), Vec3::new(0.4, 0.25, -0.1))?.into(),
            )],
        ),
        page("compound3", vec![("Compound3", arch3()?.into())]),
        page("tri_mesh", vec![("TriMesh", stairs()?.into())]),
        page("height_field", vec![("HeightField", hills()?.into())]),
    ])
}

fn flat_pages() -> Result<Vec<Page<Shape2>>, Box<dyn Error>> {
    let rect = Rect::from_half_extents(Vec2::new(0.42, 0.26))?;
    let page = |name, shapes| Page { name, shapes };
    Ok(vec![
        page("circle", vec![("Circle", Circle::new(0.42)?.into())]),
        page(
            "capsule2",
            vec![("Capsule2", Capsule2::new(Vec2::new(-0.3, -0.15), Vec2::new(0.3, 0.15), 0.22)?.into())],
        ),
        page("rect", vec![("Rect", rect.into()), ("Rect, rounded", rect.rounded(0.13)?.into())]),
        page(
            "polygon",
            vec![
                ("Polygon", pentagon(0.9)?.into()),
                ("Polygon, rounded", pentagon(0.9)?.rounded(0.13)?.into()),
            ],
        ),
        page("half_plane", vec![("HalfPlane", HalfPlane::new(Vec2::Y)?.into())]),
        page(
            "segment2",
            vec![("Segment2", Segment2::new(Vec2::new(-0.45, -0.2), Vec2::new(0.45, 0.2))?.into())],
        ),
        page("compound2", vec![("Compound2", arch2()?.into())]),
        page("chain", vec![("Chain, open", hill()?.into()), ("Chain, closed", island()?.into())]),
    ])
}

/// A chain that faces up.
fn hill() -> Result<Chain, ChainError> {
    let rise = [(0.5, -0.25), (0.28, -0.25), (0.1, -0.02), (-0.08, 0.06), (-0.26, 0.02), (-0.5, -0.2)];
    Ok(Chain::open(rise.map(|(x, y)| Vec2::new(x, y)))?.one_sided())
}

fn island() -> Result<Chain, ChainError> {
    let coast = [(0.45, -0.05), (0.2, 0.25), (-0.1, 0.16), (-0.42, 0.2), (-0.3, -0.2), (0.1, -0.26)];
    Ok(Chain::closed(coast.map(|(x, y)| Vec2::new(x, y)))?.one_sided())
}

fn draw_solids(page: &Page<Shape3>) -> String {
    let mut canvas = cards(page);
    for (i, (_, shape)) in page.shapes.iter().enumerate() {
        let (tint, camera) = (tint(i), Camera::above().scaled(SCALE));
        let triangles = far_to_near_triangles(triangles(shape), camera.toward_viewer());
        let of_triangle = |shape| Body { shape, pose: Pose3::IDENTITY, is_b: false };
        let parts = if triangles.is_empty() {
            far_to_near(parts3(shape, &Pose3::IDENTITY, false), camera.toward_viewer())
        } else {
            triangles.iter().map(of_triangle).collect()
        };
        let camera = camera.fitted(ROOM, middle(i), |camera| {
            joined(parts.iter().map(|part| Solid::new(part.shape, &part.pose, tint, camera).frame()))
        });
        for part in &parts {
            Solid::new(part.shape, &part.pose, tint, &camera).draw(&mut canvas);
        }
        for part in &parts {
            draw_core(&mut canvas, &core3(part.shape, &part.pose, &camera), tint);
        }
        draw_axes(&mut canvas, &camera, &[DVec3::X, DVec3::Y, DVec3::Z]);
    }
    canvas.finish(page.name)
}

fn draw_flats(page: &Page<Shape2>) -> String {
    let mut canvas = cards(page);
    for (i, (_, shape)) in page.shapes.iter().enumerate() {
        let tint = tint(i);
        let parts = parts2(shape, &Pose2::IDENTITY, false);
        let camera = Camera::front().scaled(SCALE).fitted(ROOM, middle(i), |camera| {
            joined(parts.iter().map(|part| Flat::new(part.shape, &part.pose, tint, camera).frame()))
        });
        for part in &parts {
            Flat::new(part.shape, &part.pose, tint, &camera).draw(&mut canvas);
        }
        for part in &parts {
            draw_core(&mut canvas, &core2(part.shape, &part.pose, &camera), tint);
        }
        draw_axes(&mut canvas, &camera, &[DVec3::X, DVec3::Y]);
    }
    canvas.finish(page.name)
}

/// The sharp shape is cool, the rounded one warm.
fn tint(number: usize) -> &'static Tint {
    if number == 0 { &COOL } else { &WARM }
}

fn low(number: usize) -> DVec2 {
    DVec2::new(GAP + (CARD_SIZE.x + GAP) * number as f64, GAP)
}

fn middle(number: usize) -> DVec2 {
    low(number) + DVec2::new(CARD_SIZE.x * 0.5, CARD_SIZE.y * 0.5 - 10.0)
}

fn cards<S>(page: &Page<S>) -> Canvas {
    let count = page.shapes.len() as f64;
    let size = DVec2::new(count * (CARD_SIZE.x + GAP) + GAP, CARD_SIZE.y + 2.0 * GAP);
    let mut canvas = Canvas::new(page.name, size);
    for (i, (caption, _)) in page.shapes.iter().enumerate() {
        canvas.card(low(i), CARD_SIZE, 8.0, &Paint::fill(CARD));
        canvas.caption(low(i) + DVec2::new(CARD_SIZE.x * 0.5, CARD_SIZE.y - 12.0), caption, 14.0);
    }
    canvas
}

/// The core of a rounded shape, on the picture.
struct Core {
    vertices: Vec<DVec2>,
    edges: Vec<(usize, usize)>,
    is_round: bool,
}

fn core3(shape: &Shape3, pose: &Pose3, camera: &Camera) -> Core {
    let core = shape.core();
    let topology = core.topology();
    Core {
        vertices: core.vertices().iter().map(|&v| camera.place(pose.transform(v))).collect(),
        edges: topology.edges().iter().map(|&edge| topology.ends(usize::from(edge))).collect(),
        is_round: shape.radius() > 0.0,
    }
}

fn core2(shape: &Shape2, pose: &Pose2, camera: &Camera) -> Core {
    let core = shape.core();
    let count = core.vertices().len();
    Core {
        vertices: core.vertices().iter().map(|&v| camera.place(pose.transform(v).extend(0.0))).collect(),
        // A segment's two edges are the same line.
        edges: (0..if count > 2 { count } else { count.saturating_sub(1) })
            .map(|edge| (edge % count, (edge + 1) % count))
            .collect(),
        is_round: shape.radius() > 0.0,
    }
}

fn draw_core(canvas: &mut Canvas, core: &Core, tint: &Tint) {
    if !core.is_round {
        return;
    }
    for &(from, to) in &core.edges {
        canvas.line(core.vertices[from], core.vertices[to], &Paint::line(tint.ink, 1.1).dashed());
    }
    for &vertex in &core.vertices {
        canvas.point(vertex, 2.8, tint.ink);
    }
}

/// The shape's own axes, from its origin.
fn draw_axes(canvas: &mut Canvas, camera: &Camera, axes: &[DVec3]) {
    let origin = camera.place(DVec3::ZERO);
    for (&axis, name) in axes.iter().zip(["x", "y", "z"]) {
        let tip = camera.place(axis * 0.2);
        canvas.line(origin, tip, &Paint::line(INK, 1.2));
        canvas.text(camera.place(axis * 0.27) + DVec2::Y * 3.0, name, (10.0, INK, Anchor::Middle));
    }
}
