//! What CPU twins read. A twin runs again on the CPU, line by line in `f32`, what could be wrong
//! unnoticed on the GPU: the file `twin.rs` in a technique's folder. Twins are kept close to the
//! shaders' text, so that the two can be compared by eye; they are for tests.

use glam::{IVec2, Vec2, Vec3, Vec4};

use crate::gpu::Gpu;
use crate::stage::Stage;
use crate::stage::view::ViewUniform;

/// `shared/mirror.wesl`: the G-buffer of one mirror.
pub(crate) struct GBuffer {
    pub size: IVec2,
    /// World space.
    pub eye: Vec3,
    pub mirror_id: u32,
    position: Vec<Vec4>,
    normal: Vec<Vec4>,
}

const SIDE_FRONT: f32 = 1.0;
const SIDE_BACK: f32 = 2.0;

impl GBuffer {
    /// The maps that searches on `mirror` (an index) read, in the frame rendered last.
    pub(crate) fn read(gpu: &Gpu, stage: &Stage, mirror: usize) -> Self {
        gpu.run(|frame| stage.record_maps(frame, mirror));
        let gbuffer = stage.maps();
        let read = |texture| {
            let texels = gpu.read_texture(texture);
            texels.into_iter().map(Vec4::from_array).collect()
        };
        Self {
            size: IVec2::from_array(stage.world.size.map(|side| side as i32)),
            eye: stage.world.scene.camera.eye.as_vec3(),
            mirror_id: stage.world.mirrors[mirror].id,
            position: read(&gbuffer.position),
            normal: read(&gbuffer.normal),
        }
    }

    fn index(&self, texel: IVec2) -> usize {
        (texel.y * self.size.x + texel.x) as usize
    }

    pub(crate) fn position(&self, texel: IVec2) -> Vec3 {
        self.position[self.index(texel)].truncate()
    }

    pub(crate) fn normal(&self, texel: IVec2) -> Vec3 {
        self.normal[self.index(texel)].truncate()
    }

    /// True where the reflecting side of this mirror is seen.
    pub(crate) fn on_mirror(&self, texel: IVec2) -> bool {
        self.side(texel).is_some_and(|side| side != SIDE_BACK)
    }

    /// True where the front of this mirror is seen, so that its reflected ray is to be followed.
    pub(crate) fn shows_front(&self, texel: IVec2) -> bool {
        self.side(texel) == Some(SIDE_FRONT)
    }

    /// Which side of this mirror is seen.
    fn side(&self, texel: IVec2) -> Option<f32> {
        if texel.cmplt(IVec2::ZERO).any() || texel.cmpge(self.size).any() {
            return None;
        }
        let is_mirror = self.position[self.index(texel)].w == self.mirror_id as f32;
        is_mirror.then(|| self.normal[self.index(texel)].w)
    }
}

/// World-space positions of all vertices, as searches read them.
pub(crate) fn vertices(stage: &Stage) -> Vec<Vec3> {
    let objects = stage.world.scene.objects.iter();
    objects
        .flat_map(|object| object.mesh.positions.iter().copied())
        .collect()
}

/// `shared/view.wesl`: image coordinates of a world-space point; `None` behind the eye.
pub(crate) fn image(view: &ViewUniform, point: Vec3) -> Option<Vec2> {
    let offset = point - view.eye;
    let depth = offset.dot(view.forward);
    let across = Vec2::new(
        offset.dot(view.right) / view.tan_x,
        -offset.dot(view.up) / view.tan_y,
    );
    (depth > 0.0).then(|| (across / depth + 1.0) * 0.5 * view.size.as_vec2())
}
