//! What every mirror shape answers, so that nobody else has to know which shape it is.

use glam::{DMat3, DVec3};

use crate::mesh::Mesh;
use crate::pose::Pose;

/// Why an open shape is not seen whole from its centre, to be read after the mirror's name.
pub(super) const OPEN: &str = "is open, and no closed shape stands for it that a centre sees whole";

/// Why a closed shape is not.
pub(super) const HIDDEN: &str = "is not seen whole from its centre, as a cube map needs";

/// A reflecting surface in world space. It has a reflecting side; the other is opaque black.
pub trait MirrorShape {
    /// Nearest hit with `t > t_min` of the ray `origin + t · dir` (`dir` of unit length), from
    /// either side; the normal is always that of the reflecting side, so a hit from behind has
    /// `dir · normal ≥ 0`. `None` for a mesh, which has no exact surface.
    fn intersect(&self, origin: DVec3, dir: DVec3, t_min: f64) -> Option<SurfaceHit>;

    /// Unit normal of the reflecting side at a point on the surface (for a point beside it: of
    /// the similar surface through it). `None` for a mesh.
    fn normal_at(&self, point: DVec3) -> Option<DVec3>;

    /// The mirror's centre, from where environment maps are taken: of the sphere for a bowl, of
    /// the bounding box for a mesh.
    fn center(&self) -> DVec3;

    /// The point whose projection stands for the middle of the mirror's: the centre, unless the
    /// surface lies all to one side of it, as a bowl's.
    fn middle(&self) -> DVec3 {
        self.center()
    }

    /// Corners of the smallest axis-parallel box around the surface (for a bowl: around its
    /// whole sphere).
    fn bounds(&self) -> (DVec3, DVec3);

    /// Triangles with vertices on the surface and exact normals of the reflecting side at each,
    /// counter-clockwise seen from that side. `segments` (at least 4) run around, half as many
    /// rings across (a torus' tube, or cells along each side of a saddle); a plane is two
    /// triangles; a mesh is returned as it is.
    fn tessellate(&self, segments: u32) -> Mesh;

    /// Triangles slightly outside the surface: every ray that meets the surface meets them too,
    /// from any eye, if both faces are drawn. A bowl's is the whole sphere, a saddle's the box
    /// around it, a mesh's the mesh.
    /// Normals are the nearest surface normals, for lack of better ones.
    fn cover(&self, segments: u32) -> Mesh;

    /// Moves the surface.
    fn carry(&mut self, pose: &Pose);

    /// True where the surface bounds a volume, so that its back is never seen from outside.
    /// A mesh is closed if each edge joins exactly two triangles (found anew at every call).
    fn is_closed(&self) -> bool;

    /// True where no point can have more than one reflection point: sphere, ellipsoid, plane.
    /// False where it can, and for meshes, of which it is not known.
    fn is_convex(&self) -> bool {
        false
    }

    /// True for a point strictly inside the surface, which must be closed.
    fn encloses(&self, _point: DVec3) -> bool {
        false
    }

    /// True for a point strictly inside a closed surface. Of many points, ask once whether the
    /// surface [is closed](Self::is_closed) and then only what it [encloses](Self::encloses).
    fn contains(&self, point: DVec3) -> bool {
        self.is_closed() && self.encloses(point)
    }

    /// The triangles of a mirror that has no exact surface.
    fn as_mesh(&self) -> Option<&Mesh> {
        None
    }

    /// True where the surface is known exactly and [`MirrorShape::intersect`] works.
    fn is_analytic(&self) -> bool {
        self.as_mesh().is_none()
    }

    /// A point and the unit normal (on the reflecting side) of the plane that the whole surface
    /// lies in, if it does.
    fn flat(&self) -> Option<(DVec3, DVec3)> {
        None
    }

    /// Which way the closed surface faces that the mirror is, or was cut from. A cube map of the surface
    /// needs the centre to see each point of it exactly once; where it does not, the error says why, to be
    /// read after the mirror's name.
    fn facing(&self) -> Result<Facing, &'static str> {
        Err(HIDDEN)
    }

    /// The one point of that surface in a unit direction from the centre, where it is known
    /// exactly.
    #[expect(
        clippy::wrong_self_convention,
        reason = "the direction is from the centre; nothing is made from it"
    )]
    fn from_center(&self, direction: DVec3) -> Option<SurfaceHit> {
        self.intersect(self.center(), direction, 0.0)
    }

    /// Whether the mirror itself lies in a unit direction from the centre, not only the closed surface that
    /// it was cut from ([`MirrorShape::facing`]).
    fn covers(&self, _direction: DVec3) -> bool {
        true
    }

    /// All numbers that give the surface, in a fixed order: they go into the scene's hash. None
    /// for a mesh, whose triangles do.
    fn numbers(&self) -> Vec<f64>;

    /// What a shader needs in order to intersect the surface; `None` for a mesh.
    fn shader_input(&self) -> Option<ShaderInput>;

    /// The same surface as an affine image of a primitive that renderers have in common.
    fn primitive(&self) -> Option<Primitive> {
        None
    }

    /// Segments with which [`MirrorShape::tessellate`] can stand for the exact surface: its
    /// triangles then lie within some 3e-6 of its size from it, about as far as f32 would place
    /// them.
    fn fine_segments(&self) -> u32 {
        1024
    }
}

/// Where a ray meets an analytic mirror.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceHit {
    /// Distance along the (unit) ray, world units.
    pub t: f64,
    /// World-space point.
    pub position: DVec3,
    /// Unit normal of the reflecting side.
    pub normal: DVec3,
}

/// Which way the reflecting side of a surface faces that is seen whole from its centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// Away from the centre.
    Outwards,
    /// Towards the centre.
    Inwards,
}

/// What a shader needs in order to intersect a surface, apart from its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShaderInput {
    /// Name of the shader module with the function: several shapes may share one.
    pub module: &'static str,
    /// World from the shape's own axes, a rotation. Of a flat shape, z is the normal.
    pub axes: DMat3,
    /// Sizes, of which each shape says what they are: mostly half extents along the axes.
    pub sizes: DVec3,
    /// Further numbers, of which each shape says what they are; 0 where it has none.
    pub more: DVec3,
    /// Of an open surface, `sizes` and the first of `more` for a larger piece, which goes on beyond the rim.
    pub beyond: Option<(DVec3, f64)>,
}

/// A surface that other renderers know, in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Primitive {
    /// A sphere.
    Sphere {
        /// Centre.
        center: DVec3,
        /// Radius.
        radius: f64,
    },
    /// The points `center + axes · p` with `|p| = 1`.
    Ellipsoid {
        /// Centre.
        center: DVec3,
        /// Half axes, perpendicular to each other.
        axes: DMat3,
    },
    /// The points `center + axes · (x, y, 0)` with x and y in [−1, 1].
    Rectangle {
        /// Centre.
        center: DVec3,
        /// Half width, half height, and the unit normal of the reflecting side.
        axes: DMat3,
    },
}
