//! Every tolerance and limit of the engine, in one place.
//!
//! A tolerance is always relative: it is multiplied by the size of what it is applied to, so that a scene of
//! pebbles and a scene of mountains are answered alike. Only the *limits* at the end carry a unit.

/// Share of a pair's size at which a cast in the plane calls two shapes that still have a gap touching.
///
/// A cast comes so close by axes alone, and then takes the last step along the axis that it has; what is left is in the
/// impact's error, and is mostly rounding. A pair that passes by within it counts as touching. A larger value makes
/// wider misses hits; with a smaller one the axis across the last gap is rounding (1e-16 of the size over the gap),
/// and so are the normals.
pub const CAST_GAP2: f64 = 1e-8;

/// Share of a hull's outer radius within which neighbouring facets count as one flat face.
///
/// f32 vertices of a truly flat face lie within 1.2e-7 of its plane, so this merges what rounding split. Larger
/// values merge real facets and cost depth accuracy (the planarity error enters every reported error); smaller
/// ones leave slivers whose normals jitter.
pub const COPLANAR: f64 = 2.5e-7;

/// Sine of the angle between two edges below which their cross product is not used as an axis.
///
/// Above it, the axis is off by rounding over the sine; below it, the face normals beside the edges give the same
/// depth within a few sines of the pair's size. Here both are some 1e-7 at worst; every axis is verified by full
/// projection, and every pair carries what its own edges leave open in its error. A larger or smaller value makes that
/// larger on one side.
pub const PARALLEL_EDGES: f64 = 4e-8;

/// Slack, in units of unit vectors' dot products, within which two arcs of the Gauss map are kept as crossing.
///
/// Derived normals are within 1e-7 of the true ones for well-shaped faces. A pair kept needlessly costs one
/// verified axis; a pair dropped wrongly costs the true depth.
pub const ARC_SLACK: f64 = 1e-6;

/// Share of the smaller shape's diameter by which another kind of axis must beat a face of A before the contact is
/// built on it.
///
/// Keeps the reference face from flipping between ties. It is also the largest regret of a reported normal, rounding
/// apart, for which it is raised where positions are far apart and shapes small.
pub const FACE_PREFERENCE: f64 = 5e-7;

/// Share of the smaller shape's diameter within which corners of a patch count as equally deep, where four of more are
/// chosen to hold it.
///
/// A body that a solver holds at rest leans now here and now there, by up to some 1e-5 rad, which lifts one side of its
/// face by as much of its width. With a smaller value the deepest corner changes with every lean, and with it which
/// four are told; with a larger one, what leans more may be held beside its deepest corner by as much. Twice as far as
/// manifolds are moved along. Only the choice of corners depends on it: what is told of the pair, and of each corner,
/// is exact. (2^-12 was tried: ids stay at 1e-4 rad, too, but a box of a metre may stand 0.4 mm beside its deepest
/// corner.)
pub const EVEN_DEPTH: f64 = 1.0 / 32_768.0;

/// How near a contact point must be to a vertex or an edge to be named after it, as a share of the smaller shape's
/// diameter.
///
/// Bodies that a solver holds tremble by up to a thousandth of their size. With a smaller value the names of points
/// between crates that stand squarely on each other change from frame to frame; with a larger one, those of bodies that
/// slide and roll do: with four times this, 14 % more new names in a crowd, with this 4 %, and with either 13 % fewer
/// in a heap of boxes. Names alone depend on it.
pub const SAME_PLACE: f64 = 1.0 / 512.0;

/// Share of their area within which four corners of a patch hold it as well as the four that hold it best.
///
/// A regular face of many corners has several fours of the same area, and a body that trembles by 1e-4 rad changes
/// areas by some 2e-4, where sides of two faces cross. A smaller value leaves it to that which four are told; a larger
/// one takes a worse four of faces of more than sixty corners, and brings nearer the 5 % that may be lost in all.
pub const EVEN_AREA: f64 = 1.0 / 1024.0;

/// Cosine of the angle up to which two faces beside a pair of touching edges count as resting on each other: 0.1 rad.
///
/// Only the choice of contact points depends on it, never an axis or a depth. A smaller angle leaves slightly tilted
/// boxes standing on one point; at a larger one the far corners are out of any useful margin.
pub const ALIGNED_FACES: f64 = 0.995;

/// Share of a pair's size at which the distance iteration stops: the gap between its two certified bounds.
pub const DISTANCE_GAP: f64 = 1e-12;

/// Share of a pair's size up to which shapes that move towards each other count as having met, where no certified step
/// brings them closer at once.
///
/// A step is along one axis, and for polytopes the last one ends at the contact up to [`IMPACT_REST`]; only round
/// or turning shapes stop here. It is part of every impact's stated error. A smaller value costs a step or two
/// where shapes graze; a larger one stops bodies visibly short.
pub const IMPACT_GAP: f64 = 1e-6;

/// Share of a pair's size that a certified step leaves between moving shapes.
///
/// Closer, the distance iteration sees little but rounding: it has 1e-15 of the size. It is part of every impact's
/// stated error, and far below an f32 rounding of the size.
pub const IMPACT_REST: f64 = 1e-9;

/// Share of a body's thickness within which what it meets next counts as level with what it touches.
///
/// It is what a body may end deeper in ground that it passes over, and how far in front of it that may begin: see
/// `next_impact` of a pair. A larger value lets bodies run deeper into ramps; a smaller one stops a ball that rolls at
/// every bend of its floor.
pub const NEXT_LEVEL: f64 = 1.0 / 64.0;

/// Share of its outer radius that a body's thickness counts for at least where [`NEXT_LEVEL`] is a share of it: so that
/// segments and thin plates do not stop at the rounding of a floor's corners.
pub const NEXT_THICKNESS: f64 = 1e-4;

/// Share of a cloud's size by which a point must stand out of the hull of those before it to count as a vertex that no
/// merging of facets takes away: 64 times [`COPLANAR`].
///
/// Only hulls with more than four times the allowed number of such points are refused by it, early. A smaller value
/// could refuse what merging would make small; a larger one lets hopeless clouds be built to the end before they are
/// refused.
pub const STANDS_OUT: f64 = 64.0 * COPLANAR;

/// Share of its inner radius that a core's ball keeps on its arm, which is a segment about the centre.
///
/// A face that the arm runs along but for rounding leaves the whole ball no way at all, and a slightly smaller one as
/// much as there is. Only proofs that spare work depend on it: a smaller value proves less of what overlaps deeply, a
/// larger one less of hulls that are long only nearly along an edge.
pub const ARM_SHARE: f64 = 63.0 / 64.0;

/// Share of a hull's half diagonal up to which a stored hull's vertices may lie beyond one of its faces: what
/// merging at [`COPLANAR`] may leave, with room.
///
/// Faces are derived data that prove nothing, so a larger value costs depth accuracy (the planarity error enters every
/// reported error) and a smaller one would refuse hulls that were built here. Where merging leaves more, of what is thinner
/// than rounding, the builder keeps the facets.
pub const MERGED_PLANARITY: f64 = 8.0 * COPLANAR;

/// Share of its coordinates by which a vertex of a chain may lie beside the line of its neighbours and count as on it.
///
/// A line that is cut into segments has vertices rounded to f32, each by 6e-8 of its coordinates, as are the ends that
/// it is measured from; this is four times as much, for what was computed in f32. A larger value takes bends for
/// rounding, and contact points lie as much beside the segments; a smaller one lets the rounding of short segments turn
/// normals.
pub const STRAIGHT: f64 = 2.0 * (f32::EPSILON as f64);

/// Sine of the angle by which a contact's normal may lean over the end of a surface and still be its own.
///
/// Normals of kernels are good to some 1e-7 where a face is touched; what leans by more is a corner's, or none of the
/// ground's. A larger value is an error that contacts on flat ground may have; a smaller one takes faces for corners.
pub const ALONG_GROUND: f64 = 1e-6;

/// Angle, in radians, up to which contact normals on ground count as one.
///
/// Two points are enough for a body on one plane, and it stands steadier on them than on several pairs. A larger value
/// merges what is curved; a smaller one leaves a manifold for each facet of what looks flat.
pub const ONE_NORMAL: f32 = 1e-4;

/// Cosine of the angle between two faces from which on their corner counts as sharp: 60 degrees.
///
/// Beyond a sharp corner, a contact is the neighbour's alone: what stands a little in one face of a step lies deep
/// behind the other. At a blunt corner it is as deep in both within a factor of one over this. A larger value drops
/// contacts of short segments; a smaller one lets the steps of stairs push sideways.
pub const SHARP_CORNER: f64 = 0.5;

/// Sine of the angle by which the loose end of one-sided ground may push against its front.
///
/// What comes from the side, a little tilted, is met by the end, though its normal leads a little backwards; what
/// comes from behind is not met.
pub const BEHIND_END: f64 = 0.2;

/// How far the square of a stored rotation's length in the plane may be from one: both components are rounded to
/// f32 once.
///
/// Twice the rounding of f32, and a little for its square. A larger value would let stored rotations stretch shapes; a
/// smaller one would refuse rotations that were made here.
pub const UNIT_ROTATION: f64 = 1.000_001 * (f32::EPSILON as f64);

/// Share of a character's bounding radius that it keeps between itself and everything, unless told otherwise.
///
/// It must be far above the rounding of positions and the error of casts, so that a character that slides along a
/// floor never meets the inner edges of its tiles; a larger one becomes visible as hovering.
pub const SKIN: f32 = 0.01;

/// The least share of its bounding radius that a character keeps between itself and everything, and what
/// it is pushed clear of solids by.
///
/// A smaller one comes near the error of casts (1e-6 of a pair's size), and then a character could come to touch
/// what it slides along.
pub const LEAST_SKIN: f64 = 1.0 / 4096.0;

/// Share of its skin that a character may lack before it is moved back to it.
///
/// Without slack the rounding of every frame would be undone by a move of the next. A larger one lets the gap change
/// visibly while it slides.
pub const SKIN_SLACK: f64 = 1.0 / 64.0;

/// Share of a displacement below which a character counts as standing still, the sine below which a direction counts
/// as along a wall rather than into it, and how far below one the cosine between the normals of one wall may be.
///
/// Above the rounding of f32 normals (6e-8) and displacements; a larger one lets characters creep into corners.
pub const STANDSTILL: f64 = 1e-6;

/// Sine of the angle below which a cast counts as grazing what it meets: the normal is then tilted by as much
/// against the way, so that sliding along it leads off.
///
/// A normal across the way would change nothing, and the next cast would meet the same again. A larger one bends
/// the way visibly.
pub const GRAZING: f64 = 1e-5;

/// Sine of the angle by which what leans over counts as an upright wall.
///
/// Walls hold back what goes into them sideways; a ceiling turns it downwards. Above the rounding of f32 normals; a
/// larger one makes walls of ceilings.
pub const UPRIGHT: f64 = 1e-3;

/// Least cosine between up and the normal where round feet touch the edge of a step. What hangs on to an edge by
/// less falls off.
///
/// A larger one lets round feet slip from stairs that are nearly as high as they are wide; at zero they would hold
/// on to edges beside them.
pub const EDGE_HOLD: f64 = 0.05;

/// Sine of the angle up to which two directions of contact on ground count as the same, and by which a direction may
/// lean over an edge or corner of ground towards a face beside it.
///
/// Triangles that were meant to lie in one plane have vertices rounded to f32, so that their normals differ by
/// that over their height. A larger value merges normals of facets that a smooth ground has on purpose; with a smaller
/// one a body on a flat floor of thin triangles has several manifolds, and may trip over their edges.
pub const SAME_NORMAL: f64 = 1e-4;

/// Share of a triangle's extent within which a point counts as lying on it, where all triangles are looked for that
/// meet in a touched point.
///
/// Above the rounding of f32 vertices, so that edges that nearly meet do; a larger value takes faces into account that
/// are beside the point, and with a smaller one what touches in an inner edge may seem to touch a rim.
pub const ON_TRIANGLE: f64 = 1e-7;

/// Sine of the angle up to which two neighbouring triangles of ground count as one plane.
///
/// Their edge then gives no normal of its own, and their contact points share a manifold and a name. It is half of
/// what two normals of one manifold may differ by (1e-4 rad), so that any two triangles of a plane come together, and
/// above what f32 vertices make of a plane of triangles a thousandth of its size. A larger one takes away edges
/// that matter; a body that rests on an edge within it has a normal that is off by as much. A smaller one makes
/// edges of rounding, which cost time.
pub const FLAT: f64 = 5e-5;

/// The smallest bounding radius a shape may have, in metres.
pub const MIN_RADIUS: f32 = 1e-6;

/// The furthest that any point of a shape may lie from the shape's origin, in metres.
pub const MAX_RADIUS: f32 = 1e6;

/// The furthest a position may lie from the origin on any axis, in metres.
pub const MAX_POSITION: f64 = 1e9;

/// The most vertices a hull may have. Hulls are meant for collision; simplify what is drawn.
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
