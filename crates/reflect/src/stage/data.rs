//! Buffer structs, laid out by encase as the shaders read them.

use catoptric_scene::{Background, Scene, Shape, View};
use encase::ShaderType;
use glam::{DVec2, DVec3, UVec2, UVec3, Vec2, Vec3};

/// Twin of `shared/view.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct ViewUniform {
    pub eye: Vec3,
    pub near: f32,
    pub right: Vec3,
    pub tan_x: f32,
    pub up: Vec3,
    pub tan_y: f32,
    pub forward: Vec3,
    pub depth_range: f32,
    pub size: UVec2,
    pub background_kind: u32,
    pub under: u32,
    pub zenith: Vec3,
    pub horizon: Vec3,
    pub nadir: Vec3,
}

/// Distance along the optical axis before which nothing is drawn, world units.
const NEAR: f32 = 1e-3;

impl ViewUniform {
    /// The scene's camera. `dark`: mirrors are black where no reflection is drawn.
    pub(crate) fn new(scene: &Scene, size: [u32; 2], dark: bool) -> Self {
        let under = u32::from(dark);
        Self {
            under,
            ..Self::from_view(scene, &scene.camera.view(size))
        }
    }

    /// Any view of the scene, such as from behind a flat mirror or out of a cube map.
    pub(crate) fn from_view(scene: &Scene, view: &View) -> Self {
        let (background_kind, zenith, horizon, nadir) = match scene.background {
            Background::Color(color) => (0, color, color, color),
            Background::Gradient {
                zenith,
                horizon,
                nadir,
            } => (1, zenith, horizon, nadir),
        };
        Self {
            eye: view.eye.as_vec3(),
            near: NEAR,
            right: view.right.as_vec3(),
            tan_x: view.tan.x as f32,
            up: view.up.as_vec3(),
            tan_y: view.tan.y as f32,
            forward: view.forward.as_vec3(),
            depth_range: diagonal(scene),
            size: UVec2::from_array(view.size),
            background_kind,
            under: 0,
            zenith,
            horizon,
            nadir,
        }
    }
}

/// No vertex is farther from a mirror point: the diagonal of the box around everything, and a
/// hundredth of it.
pub(crate) fn diagonal(scene: &Scene) -> f32 {
    let Some((low, high)) = bounds(scene) else {
        return 1.0;
    };
    ((high - low).length() * MARGIN).max(LEAST_DISTANCE) as f32
}

/// Nothing is farther from a point, wherever that lies: the distance to the far corner of the box
/// around everything, and a hundredth of it.
pub(crate) fn beyond(scene: &Scene, point: DVec3) -> f32 {
    let Some((low, high)) = bounds(scene) else {
        return 1.0;
    };
    let corner = (point - low).abs().max((high - point).abs());
    (corner.length() * MARGIN).max(LEAST_DISTANCE) as f32
}

/// Factor by which a distance is taken larger, to be sure of it in single precision.
const MARGIN: f64 = 1.01;
/// A scene without extent is taken to be so large.
const LEAST_DISTANCE: f64 = 1e-6;

/// The box around everything; `None` in an empty scene.
fn bounds(scene: &Scene) -> Option<(DVec3, DVec3)> {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for mirror in &scene.mirrors {
        let (a, b) = mirror.shape.bounds();
        low = low.min(a);
        high = high.max(b);
    }
    for position in scene
        .objects
        .iter()
        .flat_map(|object| &object.mesh.positions)
    {
        low = low.min(position.as_dvec3());
        high = high.max(position.as_dvec3());
    }
    low.cmple(high).all().then_some((low, high))
}

/// Twin of `shared/mirror.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct MirrorUniform {
    pub center: Vec3,
    pub shape: u32,
    pub eye: Vec3,
    pub id: u32,
    pub axis_x: Vec3,
    pub cos_half_angle: f32,
    pub axis_y: Vec3,
    pub curvature_x: f32,
    pub axis_z: Vec3,
    pub curvature_y: f32,
    pub radii: Vec3,
}

impl MirrorUniform {
    /// `eye` in world space.
    pub(crate) fn new(shape: &Shape, id: u32, eye: DVec3) -> Self {
        let mut axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let mut curvature = DVec2::ZERO;
        let (kind, radii, cos_half_angle) = match shape {
            Shape::Sphere { radius, .. } => (0, DVec3::splat(*radius), 0.0),
            Shape::Ellipsoid {
                radii, rotation, ..
            } => {
                axes = [rotation.x_axis, rotation.y_axis, rotation.z_axis];
                (0, *radii, 0.0)
            }
            Shape::Bowl {
                radius,
                axis,
                half_angle,
                ..
            } => {
                let x = axis.any_orthonormal_vector();
                axes = [x, axis.cross(x), *axis];
                (1, DVec3::splat(*radius), half_angle.cos())
            }
            Shape::Plane {
                normal, up, size, ..
            } => {
                axes = [up.cross(*normal), *up, *normal];
                (2, DVec3::new(size.x / 2.0, size.y / 2.0, 1.0), 0.0)
            }
            Shape::Torus {
                axis, major, minor, ..
            } => {
                let x = axis.any_orthonormal_vector();
                axes = [x, axis.cross(x), *axis];
                (3, DVec3::new(*major, *minor, 1.0), 0.0)
            }
            Shape::Saddle {
                normal,
                up,
                size,
                curvature: bend,
                ..
            } => {
                axes = [up.cross(*normal), *up, *normal];
                curvature = *bend;
                (4, DVec3::new(size.x / 2.0, size.y / 2.0, 1.0), 0.0)
            }
            Shape::Mesh(_) => (0, DVec3::ONE, 0.0),
        };
        let center = shape.center();
        Self {
            center: center.as_vec3(),
            shape: kind,
            eye: (eye - center).as_vec3(),
            id,
            axis_x: axes[0].as_vec3(),
            cos_half_angle: cos_half_angle as f32,
            axis_y: axes[1].as_vec3(),
            curvature_x: curvature.x as f32,
            axis_z: axes[2].as_vec3(),
            curvature_y: curvature.y as f32,
            radii: radii.as_vec3(),
        }
    }
}

/// Twin of `Range` in `shared/points.wesl`: which points of a batch are searched.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Range {
    pub first: u32,
    pub count: u32,
    pub warm: u32,
}

/// Twin of `Effort` in `shared/points.wesl`: what the search of one point took.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Effort {
    pub steps: u32,
    pub evaluations: u32,
    pub node_tests: u32,
    pub flags: u32,
}

/// Twin of `Corner` in `shared/surface.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Corner {
    pub uv: Vec2,
    pub vertex: u32,
    pub material: u32,
    pub color: Vec3,
    pub object: u32,
}

/// Twin of `Material` in `shared/surface.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct MaterialUniform {
    pub a: Vec3,
    pub kind: u32,
    pub b: Vec3,
    pub cells: u32,
    pub first_texel: u32,
    pub width: u32,
    pub height: u32,
}

/// Twin of `Found` in `shared/points.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Found {
    pub position: Vec3,
    pub state: u32,
    pub at: Vec2,
    pub distance: f32,
    pub image: Vec3,
}

/// Twin of `Settings` in `reflector_cubemap.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct ReflectorCubemapSettings {
    /// Texels along an edge of a face.
    pub size: u32,
    /// Most steps.
    pub iterations: u32,
    /// Length of the first step; 1 moves a point of the unit sphere from the normal's tip to the
    /// bisector's, to first order.
    pub first_step: f32,
    /// Factor of the step length where the field changes much.
    pub shrink: f32,
    /// Factor of the step length where the field changes little.
    pub grow: f32,
    /// 1: start in the eye's direction, 0: at the bisector of the directions to eye and vertex.
    pub from_eye: u32,
    /// 1: the mirror's normals point away from its centre, −1: towards it.
    pub facing: f32,
}

/// Twin of `Place` in `grid.wesl`: where a vertex of the scene lies among what is searched.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct GridPlace {
    /// Coordinates in the cell, 0 to 1.
    pub local: Vec3,
    /// A cell, or [`GridPlace::DIRECT`] + a searched point.
    pub cell: u32,
}

impl GridPlace {
    /// `cell`: the vertex is searched itself.
    pub const DIRECT: u32 = 1 << 31;
}

impl Found {
    /// `state`: the point has this reflection point.
    pub const FOUND: u32 = 0;
    /// `state`: behind the mirror's tangent plane at the point found.
    pub const HIDDEN: u32 = 1;
    /// `state`: the search has no answer.
    pub const FAILED: u32 = 2;
}

/// Twin of `Triangle` in `shared/triangle.wesl`: a piece of one of the scene's triangles.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct Piece {
    /// Corners: scene vertices, or with [`Piece::NEW`] points of the refinement.
    pub points: UVec3,
    /// The scene's triangle.
    pub source: u32,
    /// Where the corners lie in the source: weights of its second and third corner, 16 bits each.
    pub places: UVec3,
    /// How often the source was split.
    pub level: u32,
}

impl Piece {
    /// Marks a point as one of the refinement's.
    pub const NEW: u32 = 1 << 31;
}

impl Effort {
    /// `flags`: the hierarchy left a gap here.
    pub const MET_HOLE: u32 = 1;
    /// `flags`: the enlargement repair was used.
    pub const ENLARGED: u32 = 2;
    /// `flags`: the search failed and its answer is a stand-in.
    pub const STAND_IN: u32 = 4;
}

/// Twin of `Repair` in `ray_hierarchy/search.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
pub(crate) struct RepairUniform {
    pub cone: f32,
    pub sphere: f32,
    pub stop: u32,
}

#[cfg(test)]
mod tests {
    use encase::ShaderSize;

    use super::*;
    use crate::gpu::shaders::tests::parsed;
    use crate::refine::tessellation::{Chunk, Level, Settings, Totals};

    /// Names, offsets and size of a struct as a linked shader has it.
    fn shader_layout(program: &str, features: &[&str], name: &str) -> (Vec<(String, u64)>, u64) {
        let module = parsed(program, features);
        let is_it = |ty: &naga::Type| {
            let full = ty.name.as_deref().unwrap_or_default();
            full == name || full.ends_with(&format!("_{name}"))
        };
        let found = module.types.iter().find(|(_, ty)| is_it(ty));
        let (_, ty) = found.unwrap_or_else(|| panic!("{program} has no struct {name}"));
        let naga::TypeInner::Struct { members, span } = &ty.inner else {
            panic!("{name} is no struct")
        };
        let member = |member: &naga::StructMember| {
            let name = member.name.clone().unwrap_or_default();
            (name, u64::from(member.offset))
        };
        (members.iter().map(member).collect(), u64::from(*span))
    }

    #[test]
    fn nothing_is_beyond_from_wherever_it_is_seen() {
        let scene = crate::testing::scene("box");
        let diagonal = f64::from(diagonal(&scene));
        let (low, high) = bounds(&scene).expect("it has walls");
        let inside = f64::from(beyond(&scene, 0.5 * (low + high)));
        assert!((inside - 0.5 * diagonal).abs() < 1e-6 * diagonal);
        let far_off = high + DVec3::splat(100.0);
        assert!(f64::from(beyond(&scene, far_off)) > far_off.distance(low));
    }

    /// Checks a buffer struct against a shader, member by member.
    macro_rules! check {
        ($ty:ident, $program:literal, $features:expr, $name:literal, [$($field:ident),*]) => {{
            let _every_field = |value: $ty| { let $ty { $($field: _),* } = value; };
            let names = [$(stringify!($field)),*];
            let members: Vec<_> = (names.iter().enumerate())
                .map(|(index, name)| (name.to_string(), <$ty as ShaderType>::METADATA.offset(index)))
                .collect();
            let expected = shader_layout($program, $features, $name);
            assert_eq!((members, $ty::SHADER_SIZE.get()), expected, "{}", $name);
        }};
    }

    #[test]
    fn buffer_structs_lie_as_the_shaders_read_them() {
        check!(
            ViewUniform,
            "composite",
            &[],
            "View",
            [
                eye,
                near,
                right,
                tan_x,
                up,
                tan_y,
                forward,
                depth_range,
                size,
                background_kind,
                under,
                zenith,
                horizon,
                nadir
            ]
        );
        check!(
            MirrorUniform,
            "gbuffer",
            &[],
            "Mirror",
            [
                center,
                shape,
                eye,
                id,
                axis_x,
                cos_half_angle,
                axis_y,
                curvature_x,
                axis_z,
                curvature_y,
                radii
            ]
        );
        check!(
            Corner,
            "primary",
            &[],
            "Corner",
            [uv, vertex, material, color, object]
        );
        check!(
            MaterialUniform,
            "primary",
            &[],
            "Material",
            [a, kind, b, cells, first_texel, width, height]
        );
        check!(Range, "linear", &[], "Range", [first, count, warm]);
        check!(
            Found,
            "linear",
            &[],
            "Found",
            [position, state, at, distance, image]
        );
        check!(
            Effort,
            "linear",
            &["count"],
            "Effort",
            [steps, evaluations, node_tests, flags]
        );
        check!(
            RepairUniform,
            "ray_hierarchy/search",
            &["enlarge", "stop"],
            "Repair",
            [cone, sphere, stop]
        );
        check!(
            ReflectorCubemapSettings,
            "reflector_cubemap",
            &[],
            "Settings",
            [size, iterations, first_step, shrink, grow, from_eye, facing]
        );
        check!(GridPlace, "grid", &[], "Place", [local, cell]);
        check!(
            Piece,
            "virtual",
            &["split"],
            "Triangle",
            [points, source, places, level]
        );
        check!(
            Settings,
            "tessellation",
            &[],
            "Settings",
            [threshold, level]
        );
        check!(Chunk, "tessellation", &[], "Chunk", [first, count]);
        check!(
            Level,
            "tessellation",
            &[],
            "Level",
            [groups, count, draw, finished, points, splits, index]
        );
        check!(
            Totals,
            "tessellation",
            &[],
            "Totals",
            [by_level, points, unfinished]
        );
    }
}
