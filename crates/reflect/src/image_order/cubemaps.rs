//! Cube maps of the scene: colour, id and world distance seen from several centres. If asked for, they show the
//! mirrors too, with normals, among the objects or in maps of their own. Read by `shared/maps.wesl`.

use catoptric_scene::{Scene, View};
use encase::ShaderType;
use glam::{DVec2, DVec3};

use crate::error::ReflectError;
use crate::gpu::{
    Begin, DEPTH, FLOAT4, Gpu, RasterEntries, Recorder, Slot, group, layout, module, raster_to,
    set_uniform, storage_bytes, target, texture_array, uniform,
};
use crate::options::{options, words};
use crate::stage::Stage;
use crate::stage::extent::{beyond, diagonal};
use crate::stage::mirror::MirrorUniform;
use crate::stage::view::ViewUniform;
use crate::stage::world::MirrorPipelines;

words! {
    /// Texels a side of a cube face: each a power of two, so that a pyramid ends in one cell.
    pub(crate) enum Size {
        Texels256 = "256",
        Texels32 = "32",
        Texels64 = "64",
        Texels128 = "128",
        Texels512 = "512",
        Texels1024 = "1024",
    }
}

impl Size {
    /// The number.
    pub(crate) fn texels(self) -> u32 {
        match self {
            Self::Texels256 => 256,
            Self::Texels32 => 32,
            Self::Texels64 => 64,
            Self::Texels128 => 128,
            Self::Texels512 => 512,
            Self::Texels1024 => 1024,
        }
    }
}

words! {
    /// When maps are drawn.
    pub(crate) enum Update {
        /// When the technique is made ready.
        Static = "static",
        /// In every frame.
        Frame = "frame",
    }
}

options! {
    /// Options of techniques that look into cube maps of the scene.
    pub(crate) struct MapOptions {
        /// texels a side of a cube face
        size: Size,
        /// whether the maps are drawn once or in every frame
        update: Update,
    }
}

/// Faces of a cube.
pub(crate) const FACES: u32 = 6;
/// Format of world distances.
const DISTANCE: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;
/// Format of encoded normals.
const NORMAL: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Float;

/// Twin of `Maps` in `shared/maps.wesl`.
#[derive(Clone, Copy, Debug, ShaderType)]
struct MapsUniform {
    size: u32,
    count: u32,
    far: f32,
    diagonal: f32,
    mirrors: u32,
}

words! {
    /// Where maps show mirrors.
    pub(crate) enum MirrorsIn {
        /// Among the objects, in the maps that rays are traced in.
        Among = "among",
        /// In further maps, alone, from the same centres.
        Apart = "apart",
    }
}

/// What a set of cube maps is.
#[derive(Clone, Debug)]
pub(crate) struct Wanted {
    /// Texels a side of a face, a power of two.
    pub size: u32,
    /// World-space centres of the maps.
    pub centers: Vec<DVec3>,
    /// Maps that rays are traced in: the first ones.
    pub traced: usize,
    /// Where the mirrors are shown, with their normals; `None` for nowhere.
    pub mirrors: Option<MirrorsIn>,
}

impl Wanted {
    /// Centres of all maps in the order of their layers.
    fn all_centers(&self) -> impl Iterator<Item = DVec3> + '_ {
        let apart = self.mirrors == Some(MirrorsIn::Apart);
        let again = if apart { self.traced } else { 0 };
        let again = self.centers[..again].iter();
        self.centers.iter().chain(again).copied()
    }

    /// The place of a map among those that show mirrors, if it is one.
    fn among_mirrored(&self, map: usize) -> Option<usize> {
        match self.mirrors? {
            MirrorsIn::Among => (map < self.traced).then_some(map),
            MirrorsIn::Apart => map.checked_sub(self.centers.len()),
        }
    }
}

/// Bytes of so many cube maps that rays are traced in, with the mirrors' maps and normals.
pub(crate) fn bytes(size: u32, count: usize, mirrors: Option<MirrorsIn>) -> u64 {
    let normals = mirrors.is_some();
    let count = if mirrors == Some(MirrorsIn::Apart) {
        2 * count
    } else {
        count
    };
    let formats = [FLOAT4, DISTANCE]
        .into_iter()
        .chain(normals.then_some(NORMAL));
    let texel = formats.map(|format| u64::from(format.block_copy_size(None).unwrap_or(0)));
    u64::from(FACES) * u64::from(size).pow(2) * count as u64 * texel.sum::<u64>()
}

/// Cube maps that stand ready to be drawn and read.
pub(crate) struct CubeMaps {
    wanted: Wanted,
    uniform: wgpu::Buffer,
    centers: wgpu::Buffer,
    pub colors: wgpu::Texture,
    pub distances: wgpu::Texture,
    pub normals: Option<wgpu::Texture>,
    depth: wgpu::Texture,
    faces: Vec<Face>,
    objects: wgpu::RenderPipeline,
    mirrored: Option<Mirrored>,
}

/// One face of one map.
struct Face {
    view: wgpu::Buffer,
    group: wgpu::BindGroup,
    /// Colour, distance, normal.
    targets: Vec<wgpu::TextureView>,
}

/// What draws mirrors into maps.
struct Mirrored {
    /// Draws the objects among which the mirrors are.
    objects: Option<wgpu::RenderPipeline>,
    pipelines: MirrorPipelines,
    /// By map, mirror: uniform of the mirror seen from the map's centre, and its group.
    mirrors: Vec<Vec<(wgpu::Buffer, wgpu::BindGroup)>>,
}

/// Bindings 0 to 3 of group 3 in shaders that read cube maps; `more` follow.
pub(crate) fn maps_layout(gpu: &Gpu, label: &str, more: &[Slot]) -> wgpu::BindGroupLayout {
    let mut slots = vec![Slot::Uniform, Slot::Read, Slot::Textures, Slot::Textures];
    slots.extend(more);
    layout(gpu, label, &slots)
}

impl CubeMaps {
    /// # Errors
    /// Maps that the device cannot hold.
    pub(crate) fn new(gpu: &Gpu, stage: &Stage, wanted: Wanted) -> Result<Self, ReflectError> {
        let world = &stage.world;
        let layers = FACES * wanted.all_centers().count() as u32;
        let array = |label, format| {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
            texture_array(gpu, label, [wanted.size, layers], 1, format, usage)
        };
        let colors = array("map color", FLOAT4);
        let distances = array("map distance", DISTANCE);
        let normals = wanted.mirrors.map(|_| array("map normal", NORMAL));
        gpu.check()?;
        let layer_view = |texture: &wgpu::Texture, layer| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2),
                base_array_layer: layer,
                array_layer_count: Some(1),
                ..Default::default()
            })
        };
        let views = face_views(&world.scene, &wanted);
        let faces = views.iter().zip(0..).map(|(data, layer)| {
            let mirrored = wanted.among_mirrored((layer / FACES) as usize);
            let textures = [Some(&colors), Some(&distances)];
            let normals = normals.as_ref().filter(|_| mirrored.is_some());
            let textures = textures.into_iter().chain([normals]).flatten();
            let view = uniform(gpu, data);
            Face {
                group: group(gpu, &world.view_layout, &[view.as_entire_binding()]),
                view,
                targets: textures.map(|texture| layer_view(texture, layer)).collect(),
            }
        });
        let faces = faces.collect();
        let apart = wanted.mirrors == Some(MirrorsIn::Apart);
        let features: &[&str] = if apart { &["apart"] } else { &[] };
        let module = module(gpu, "cubemaps", features)?;
        let layouts = [Some(&world.view_layout), None, Some(&world.surface_layout)];
        let entries = |vertex, fragment| RasterEntries {
            module: &module,
            vertex,
            fragment,
        };
        let plain = entries("vertex", "objects");
        Ok(Self {
            uniform: uniform(gpu, &maps_uniform(&world.scene, &wanted)),
            centers: storage_bytes(gpu, bytemuck::cast_slice(&center_texels(&wanted))),
            depth: target(gpu, "map depth", [wanted.size; 2], DEPTH),
            objects: raster_to(gpu, plain, &[FLOAT4, DISTANCE], true, &layouts, &[]),
            mirrored: (wanted.mirrors).map(|_| Mirrored::new(gpu, stage, &wanted, &entries)),
            colors,
            distances,
            normals,
            faces,
            wanted,
        })
    }

    /// Texels a side of a face.
    pub(crate) fn size(&self) -> u32 {
        self.wanted.size
    }

    /// World-space centres of the maps that rays are traced in.
    pub(crate) fn centers(&self) -> &[DVec3] {
        &self.wanted.centers[..self.wanted.traced]
    }

    /// World distance at which the background is taken to be.
    pub(crate) fn far(&self, scene: &Scene) -> f32 {
        far(scene, &self.wanted)
    }

    /// The uniform `Maps`.
    pub(crate) fn uniform(&self) -> wgpu::BindingResource<'_> {
        self.uniform.as_entire_binding()
    }

    /// Maps that rays are traced in.
    pub(crate) fn traced(&self) -> usize {
        self.wanted.traced
    }

    /// Takes over what moved around the maps; they are drawn anew by [`CubeMaps::record`].
    pub(crate) fn refresh(&mut self, gpu: &Gpu, stage: &Stage) {
        let centers = self.wanted.centers.clone();
        self.set_centers(gpu, stage, &centers);
    }

    /// Moves the maps, as many as before; they are drawn anew by [`CubeMaps::record`].
    pub(crate) fn set_centers(&mut self, gpu: &Gpu, stage: &Stage, centers: &[DVec3]) {
        assert_eq!(centers.len(), self.wanted.centers.len());
        self.wanted.centers = centers.to_vec();
        let scene = &stage.world.scene;
        set_uniform(gpu, &self.uniform, &maps_uniform(scene, &self.wanted));
        let texels = center_texels(&self.wanted);
        gpu.queue
            .write_buffer(&self.centers, 0, bytemuck::cast_slice(&texels));
        for (face, data) in self.faces.iter().zip(face_views(scene, &self.wanted)) {
            set_uniform(gpu, &face.view, &data);
        }
        let mirrored = self.mirrored.iter().flat_map(|mirrored| &mirrored.mirrors);
        for (center, mirrors) in self.wanted.centers.iter().zip(mirrored) {
            for ((buffer, _), data) in mirrors.iter().zip(mirrors_from(stage, *center)) {
                set_uniform(gpu, buffer, &data);
            }
        }
    }

    /// Draws all faces, as the pass `maps`.
    pub(crate) fn record(&self, frame: &mut Recorder<'_>, stage: &Stage) {
        let world = &stage.world;
        for (face, layer) in self.faces.iter().zip(0_usize..) {
            let map = layer / FACES as usize;
            let targets: Vec<_> = face.targets.iter().collect();
            let depth = Some((&self.depth, Begin::Clear));
            let mirrored = self.mirrored.as_ref().zip(self.wanted.among_mirrored(map));
            let objects = match mirrored {
                Some((mirrored, _)) => mirrored.objects.as_ref(),
                None => Some(&self.objects),
            };
            frame.render("maps", &targets, Begin::Clear, depth, |pass| {
                pass.set_bind_group(0, &face.group, &[]);
                if let Some(objects) = objects {
                    pass.set_pipeline(objects);
                    pass.set_bind_group(2, &world.surface_group, &[]);
                    pass.draw(0..world.corners, 0..1);
                }
                let Some((mirrored, index)) = mirrored else {
                    return;
                };
                for ((_, group), mirror) in mirrored.mirrors[index].iter().zip(&world.mirrors) {
                    pass.set_bind_group(1, group, &[]);
                    mirrored.pipelines.draw(pass, mirror);
                }
            });
        }
    }

    /// Resources of bindings 0 to 3 ([`maps_layout`]), the textures' views made by the caller.
    pub(crate) fn resources<'a>(
        &'a self,
        [colors, distances]: [&'a wgpu::TextureView; 2],
    ) -> [wgpu::BindingResource<'a>; 4] {
        [
            self.uniform.as_entire_binding(),
            self.centers.as_entire_binding(),
            wgpu::BindingResource::TextureView(colors),
            wgpu::BindingResource::TextureView(distances),
        ]
    }

    /// Views of colours and distances as [`CubeMaps::resources`] takes them.
    pub(crate) fn views(&self) -> [wgpu::TextureView; 2] {
        [array_view(&self.colors), array_view(&self.distances)]
    }
}

impl Mirrored {
    fn new<'a>(
        gpu: &Gpu,
        stage: &Stage,
        wanted: &Wanted,
        entries: &impl Fn(&'static str, &'static str) -> RasterEntries<'a>,
    ) -> Self {
        let world = &stage.world;
        let mirror_layout = layout(gpu, "mirror in a map", &[Slot::Uniform]);
        let traced = &wanted.centers[..wanted.traced];
        let mirrors = traced.iter().map(|center| {
            let of_mirror = |data| {
                let buffer = uniform(gpu, &data);
                let group = group(gpu, &mirror_layout, &[buffer.as_entire_binding()]);
                (buffer, group)
            };
            mirrors_from(stage, *center).map(of_mirror).collect()
        });
        let formats = [FLOAT4, DISTANCE, NORMAL];
        let objects = [Some(&world.view_layout), None, Some(&world.surface_layout)];
        let by_points = [
            "mirror_vertex",
            "mirror_exact",
            "triangle_vertex",
            "mirror_exact_triangle",
            "mirror_mesh",
        ];
        let pipelines = MirrorPipelines::new(by_points, |[vertex, fragment], buffers| {
            let layouts = [
                Some(&world.view_layout),
                Some(&mirror_layout),
                None,
                Some(&world.corners_layout),
            ];
            let entries = entries(vertex, fragment);
            raster_to(gpu, entries, &formats, true, &layouts, buffers)
        });
        let with_normals = entries("vertex", "objects_and_normals");
        let among = wanted.mirrors == Some(MirrorsIn::Among);
        Self {
            objects: among.then(|| raster_to(gpu, with_normals, &formats, true, &objects, &[])),
            pipelines,
            mirrors: mirrors.collect(),
        }
    }
}

/// All layers of a texture.
pub(crate) fn array_view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

fn maps_uniform(scene: &Scene, wanted: &Wanted) -> MapsUniform {
    MapsUniform {
        size: wanted.size,
        count: wanted.traced as u32,
        far: far(scene, wanted),
        diagonal: diagonal(scene),
        mirrors: wanted.centers.len() as u32,
    }
}

/// The background lies where no object is, seen from any of the centres, and no nearer than the
/// scene's diagonal.
fn far(scene: &Scene, wanted: &Wanted) -> f32 {
    let centers = wanted.centers.iter();
    let beyond = centers.map(|center| beyond(scene, *center));
    beyond.fold(diagonal(scene), f32::max)
}

fn center_texels(wanted: &Wanted) -> Vec<[f32; 4]> {
    let texel = |center: DVec3| center.as_vec3().extend(1.0).to_array();
    wanted.all_centers().map(texel).collect()
}

/// Views through all faces of all maps, in the order of the layers.
fn face_views(scene: &Scene, wanted: &Wanted) -> Vec<ViewUniform> {
    let faces = |center: DVec3| {
        let views = (0..FACES).map(|face| face_view(center, face, wanted.size));
        views.collect::<Vec<_>>()
    };
    let views = wanted.all_centers().flat_map(faces);
    views
        .map(|view| ViewUniform::from_view(scene, &view))
        .collect()
}

/// The view through one face: the twin of `face_direction` in `shared/cubemap.wesl`.
fn face_view(center: DVec3, face: u32, size: u32) -> View {
    let axis = |index: u32| DVec3::AXES[index as usize % 3];
    let outwards = face / 2;
    View {
        eye: center,
        right: axis(outwards + 1),
        up: -axis(outwards + 2),
        forward: axis(outwards) * if face % 2 == 1 { -1.0 } else { 1.0 },
        tan: DVec2::ONE,
        size: [size; 2],
    }
}

/// All mirrors as seen from a centre.
fn mirrors_from(stage: &Stage, center: DVec3) -> impl Iterator<Item = MirrorUniform> {
    let scene = &stage.world.scene;
    let mirrors = scene.mirrors.iter().zip(&stage.world.mirrors);
    mirrors.map(move |(mirror, on_gpu)| MirrorUniform::new(&*mirror.shape, on_gpu.id, center))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::Words;
    use crate::testing::assert_layout;

    /// Rounding of f64 in texels.
    const TEXELS: f64 = 1e-9;

    #[test]
    fn a_size_is_the_number_that_it_is_written_as() {
        for (size, word) in Size::ALL.iter().zip(Size::WORDS) {
            assert_eq!(size.texels().to_string(), *word);
            assert!(size.texels().is_power_of_two());
        }
    }

    #[test]
    fn the_maps_lie_as_shaders_read_them() {
        for program in [
            "environment_map",
            "cubemap_trace/march",
            "cubemap_trace/pyramid",
        ] {
            assert_layout!(
                MapsUniform {
                    size,
                    count,
                    far,
                    diagonal,
                    mirrors
                },
                program,
                &["texels"],
                "Maps"
            );
        }
    }

    /// The twin of `face_point` in `shared/cubemap.wesl`, for directions within a face.
    fn face_point(direction: DVec3) -> (u32, DVec2) {
        let axis = direction.abs().max_position();
        let [a, b, c] = [0, 1, 2].map(|step| direction[(axis + step) % 3]);
        (
            2 * axis as u32 + u32::from(a < 0.0),
            DVec2::new(b, c) / a.abs(),
        )
    }

    #[test]
    fn a_face_is_drawn_as_it_is_looked_up() {
        let center = DVec3::new(0.3, -1.0, 2.0);
        for x in -2..=2 {
            for y in -2..=2 {
                for z in -2..=2 {
                    // No two components equally long: on an edge two faces hold the point.
                    let direction =
                        DVec3::new(f64::from(x), 1.1 * f64::from(y), 1.3 * f64::from(z));
                    if direction == DVec3::ZERO {
                        continue;
                    }
                    let (face, at) = face_point(direction);
                    let (texel, _) = face_view(center, face, 64)
                        .project(center + 3.0 * direction)
                        .expect("before the face");
                    let looked_up = (at + 1.0) * 32.0;
                    assert!(texel.distance(looked_up) < TEXELS, "{direction}");
                }
            }
        }
    }
}
