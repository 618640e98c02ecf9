//! Every tolerance and limit of the engine, in one place.
//!
//! A tolerance is always relative: it is multiplied by the size of the shapes that it is applied to, so that a scene of
//! pebbles and a scene of mountains get the same treatment. Only the *limits* at the end carry a unit.

/// Gap, as a share of a pair's size, at which a cast in the plane reports two shapes as touching.
///
/// A cast advances by separating axes until the gap is this small, and takes the last step along the axis that it has
/// then; the rest is in the impact's error, and is mostly rounding. A pair that passes by within this gap counts as
/// touching. A larger value turns wider misses into hits; with a smaller one the axis across the last gap, and so the
/// normal, is rounding (1e-16 of the size over the gap).
pub const CAST_GAP2: f64 = 1e-8;

/// Share of half the diagonal of a hull's box within which neighbouring facets count as one flat face.
///
/// f32 vertices of a truly flat face lie within 1.2e-7 of its plane, so this merges what rounding split. Larger
/// values merge real facets and cost depth accuracy (the planarity error enters every reported error); smaller
/// ones leave slivers whose normals jitter.
pub const COPLANAR: f64 = 2.5e-7;

/// Sine of the angle between two edges below which their cross product is not used as an axis.
///
/// Above it, the axis is off by rounding divided by the sine; below it, the normals of the faces beside the edges give
/// the same depth up to a few times the sine, as a share of the pair's size. At this value both errors are some 1e-7 at
/// worst; a larger or a smaller value increases one of them. Every axis is verified by full projection, and the error
/// of every pair includes what its own edges leave open.
pub const PARALLEL_EDGES: f64 = 4e-8;

/// Slack, as a dot product of unit vectors, within which two arcs of the Gauss map still count as crossing.
///
/// Computed normals are within 1e-7 of the true ones for well-shaped faces. A pair of edges kept needlessly costs one
/// verified axis; a pair dropped wrongly loses the true depth.
pub const ARC_SLACK: f64 = 1e-6;

/// Share of the smaller shape's diameter by which another kind of axis must beat a face of A before the contact is
/// built on it.
///
/// Keeps the reference face from flipping between ties. It also bounds how much more depth a reported normal may have
/// than the best one, apart from rounding; where shapes are small and positions far apart, it is raised to cover
/// rounding.
pub const FACE_PREFERENCE: f64 = 5e-7;

/// Difference in depth, as a share of the smaller shape's diameter, within which corners of a contact patch count as
/// equally deep when four of them are chosen to represent it.
///
/// A body that a solver holds at rest rocks by up to some 1e-5 rad, which lifts one side of its face by that share of
/// its width. With a smaller value the deepest corner changes with every rocking, and with it the four that are
/// reported; with a larger one, a body that leans further may be supported beside its deepest corner by as much. It is
/// twice as far as manifolds are moved along. Only the choice of corners depends on it: the numbers of the pair and of
/// each corner are exact. (2^-12 was tried: ids then stay at 1e-4 rad, too, but a box of a metre may stand 0.4 mm
/// beside its deepest corner.)
pub const EVEN_DEPTH: f64 = 1.0 / 32_768.0;

/// How near a contact point must be to a vertex or an edge to get its feature id from it, as a share of the smaller
/// shape's diameter.
///
/// Bodies that a solver holds tremble by up to a thousandth of their size. With a smaller value the ids of points
/// between crates that stand squarely on each other change from frame to frame; with a larger one, those of bodies that
/// slide and roll do: with four times this there are 14 % more new ids in a crowd, with this 4 %, and with either 13 %
/// fewer in a heap of boxes. Only ids depend on it.
pub const SAME_PLACE: f64 = 1.0 / 512.0;

/// Share of area within which four corners of a contact patch count as representing it as well as the best four.
///
/// A regular face with many corners has several sets of four with the same area, and a body that trembles by 1e-4 rad
/// changes areas by some 2e-4, where sides of two faces cross. With a smaller value that trembling decides which four
/// are reported; a larger one takes a worse four on faces of more than sixty corners, and comes nearer to the 5 % that
/// may be lost in all.
pub const EVEN_AREA: f64 = 1.0 / 1024.0;

/// Cosine of the angle up to which two faces beside a pair of touching edges count as resting on each other (0.1 rad).
///
/// Only the choice of contact points depends on it, never an axis or a depth. A smaller angle leaves slightly tilted
/// boxes standing on one point; with a larger one the far corners are beyond any useful margin.
pub const ALIGNED_FACES: f64 = 0.995;

/// Gap between the two certified bounds of the distance iteration, as a share of a pair's size, at which it stops.
pub const DISTANCE_GAP: f64 = 1e-12;

/// Gap, as a share of a pair's size, up to which approaching shapes count as having met if no certified step brings
/// them closer at once.
///
/// A step uses one axis, and for polytopes the last one ends at the contact up to [`IMPACT_REST`]; only round or
/// turning shapes stop here. It is part of every impact's stated error. A smaller value costs a step or two where
/// shapes graze; with a larger one bodies stop visibly short.
pub const IMPACT_GAP: f64 = 1e-6;

/// Gap that a certified step leaves between moving shapes, as a share of a pair's size.
///
/// Any closer, the distance iteration, whose rounding is 1e-15 of the size, sees little else. It is part of every
/// impact's stated error, and far below an f32 rounding of the size.
pub const IMPACT_REST: f64 = 1e-9;

/// Share of a body's thickness within which the next part that it meets counts as level with a part that it touches.
///
/// It is how much deeper a body may end in ground that it passes over, and how far in front of the body that ground may
/// begin: see `next_impact` of a pair. A larger value lets bodies run deeper into ramps; a smaller one stops a rolling
/// ball at every bend of its floor.
pub const NEXT_LEVEL: f64 = 1.0 / 64.0;

/// Least thickness of a body for [`NEXT_LEVEL`], as a share of its outer radius, so that segments and thin plates do
/// not stop at the rounding of a floor's corners.
pub const NEXT_THICKNESS: f64 = 1e-4;

/// Share of a cloud's size by which a point must stand out of the hull of those before it to count as a vertex that no
/// merging of facets takes away: 64 times [`COPLANAR`].
///
/// It only serves to reject, early, hulls with more than four times the allowed number of such points. A smaller value
/// could reject hulls that merging would make small enough; with a larger one hopeless clouds are built to the end
/// before they are rejected.
pub const STANDS_OUT: f64 = 64.0 * COPLANAR;

/// Share of a hull's half diagonal up to which a stored hull's vertices may lie beyond one of its faces: what
/// merging at [`COPLANAR`] may leave, with room.
///
/// Faces are derived data that prove nothing, so a larger value costs depth accuracy (the planarity error enters every
/// reported error), and a smaller one would reject hulls that were built here. Where merging would leave more, in hulls
/// thinner than rounding, the builder keeps the facets.
pub const MERGED_PLANARITY: f64 = 8.0 * COPLANAR;

/// Share of its coordinates by which a vertex of a chain may lie off the line of its neighbours and count as on it.
///
/// The vertices of a line that is cut into segments are rounded to f32, each by 6e-8 of its coordinates, as are the
/// ends that it is measured from; this is four times as much, for vertices computed in f32. A larger value takes bends
/// for rounding, and contact points lie off the segments by as much; a smaller one lets the rounding of short segments
/// turn normals.
pub const STRAIGHT: f64 = 2.0 * (f32::EPSILON as f64);

/// Sine of the angle by which a contact's normal may lean over the end of a surface and still count as the surface's
/// normal.
///
/// Normals of kernels are good to some 1e-7 where a face is touched; one that leans by more belongs to a corner, or not
/// to this ground. A larger value is an error that contacts on flat ground may have; a smaller one takes faces for
/// corners.
pub const ALONG_GROUND: f64 = 1e-6;

/// Angle, in radians, up to which contact normals on ground count as equal.
///
/// Two points are enough for a body on one plane, and it stands more steadily on them than on several pairs. A larger
/// value merges curved ground; a smaller one gives ground that looks flat a manifold for each facet.
pub const ONE_NORMAL: f32 = 1e-4;

/// Cosine of the least angle between two faces whose corner counts as sharp: 60 degrees.
///
/// Beyond a sharp corner, a contact belongs to the neighbour alone: a body a little deep in one face of a step is far
/// behind the other. At a blunt corner its depths in both differ by a factor of at most one over this. A larger value
/// drops contacts of short segments; a smaller one lets the steps of stairs push sideways.
pub const SHARP_CORNER: f64 = 0.5;

/// Sine of the angle by which a normal at the loose end of one-sided ground may point behind its front.
///
/// A body that comes from the side, a little tilted, is met by the end although the normal points a little backwards;
/// one that comes from behind is not.
pub const BEHIND_END: f64 = 0.2;

/// How far the squared length of a stored rotation in the plane may be from one: both components are rounded to f32
/// once.
///
/// Twice the rounding of f32, and a little for its square. A larger value would let stored rotations stretch shapes; a
/// smaller one would reject rotations that were made here.
pub const UNIT_ROTATION: f64 = 1.000_001 * (f32::EPSILON as f64);

/// Default of the gap that a character keeps to all solids, as a share of its bounding radius.
///
/// It must be far above the rounding of positions and the error of casts, so that a character that slides along a
/// floor never meets the inner edges of its tiles; a larger one becomes visible as hovering.
pub const SKIN: f32 = 0.01;

/// The least gap that a character keeps to all solids, as a share of its bounding radius, and by how much it is pushed
/// clear of them.
///
/// A smaller one comes near the error of casts (1e-6 of a pair's size), so that a character could touch the surface
/// along which it slides.
pub const LEAST_SKIN: f64 = 1.0 / 4096.0;

/// Share of its skin by which a character may be too near to a solid before it is moved away.
///
/// Without slack every frame would move it to undo the rounding of the last. With a larger one the gap changes visibly
/// while it slides.
pub const SKIN_SLACK: f64 = 1.0 / 64.0;

/// Share of a displacement below which a character counts as standing still, the sine below which a direction counts
/// as along a wall rather than into it, and how far below one the cosine between the normals of one wall may be.
///
/// Above the rounding of f32 normals (6e-8) and displacements; a larger one lets characters creep into corners.
pub const STANDSTILL: f64 = 1e-6;

/// Sine of the angle below which a cast counts as grazing the surface that it meets: the normal is then tilted by as
/// much against the motion, so that sliding along it leads away.
///
/// A normal perpendicular to the motion would change nothing, and the next cast would meet the same again. A larger
/// value bends the path visibly.
pub const GRAZING: f64 = 1e-5;

/// Sine of the angle up to which an overhanging surface counts as an upright wall.
///
/// A wall stops sideways motion into it; a ceiling turns it downwards. Above the rounding of f32 normals; a larger
/// value makes walls of ceilings.
pub const UPRIGHT: f64 = 1e-3;

/// Least cosine between up and the normal where round feet touch the edge of a step; with less, the character falls
/// off.
///
/// With a larger value round feet slip off stairs that are nearly as high as they are wide; at zero they would hold on
/// to edges beside them.
pub const EDGE_HOLD: f64 = 0.05;

/// Sine of the angle up to which two directions of contact on ground count as the same, and by which a direction may
/// lean over an edge or corner of ground towards a face beside it.
///
/// Triangles meant to lie in one plane have vertices rounded to f32, so that their normals differ by that rounding over
/// their height. A larger value merges normals of facets that smooth ground has on purpose; with a smaller one a body
/// on a flat floor of thin triangles has several manifolds, and may trip over their edges.
pub const SAME_NORMAL: f64 = 1e-4;

/// Share of a triangle's extent within which a point counts as lying on it, in the search for all triangles that meet
/// in a touched point.
///
/// Above the rounding of f32 vertices, so that edges that nearly meet count as meeting. A larger value includes faces
/// that are beside the point; with a smaller one a contact at an inner edge may seem to be at a rim.
pub const ON_TRIANGLE: f64 = 1e-7;

/// Sine of the angle up to which two neighbouring triangles of ground count as one plane.
///
/// Their edge then gives no normal, and their contact points share a manifold and its id. It is half of what two
/// normals of one manifold may differ by (1e-4 rad), so that any two triangles of a plane come together, and above the
/// rounding of f32 vertices in a plane whose triangles are a thousandth of its size. A larger value removes edges that
/// matter, and the normal of a body that rests on such an edge is off by as much. A smaller one makes edges of
/// rounding, which cost time.
pub const FLAT: f64 = 5e-5;

/// The smallest bounding radius a shape may have, in metres.
pub const MIN_RADIUS: f32 = 1e-6;

/// The furthest that any point of a shape may lie from the shape's origin, in metres.
pub const MAX_RADIUS: f32 = 1e6;

/// The furthest a position may lie from the origin on any axis, in metres.
pub const MAX_POSITION: f64 = 1e9;

/// The most vertices a hull may have. Hulls are meant for collision; simplify meshes that are made for drawing.
pub const MAX_HULL_VERTICES: usize = 256;

/// The most points that a hull may be built from.
pub const MAX_HULL_POINTS: usize = 65_535;

/// The most vertices a polygon may have.
pub const MAX_POLYGON_VERTICES: usize = 4096;

/// The most parts a compound may have.
pub const MAX_PARTS: usize = 4096;

/// The most vertices a chain may have.
pub const MAX_CHAIN_VERTICES: usize = 2_000_000;

/// The most triangles a mesh may have.
pub const MAX_TRIANGLES: usize = 2_000_000;

/// The most vertices a mesh may have: three for each triangle.
pub const MAX_MESH_VERTICES: usize = 3 * MAX_TRIANGLES;

/// The most heights on a side of a height field.
pub const MAX_FIELD_SIDE: usize = 4097;
