//! Which clusters the large nodes may meet, and what the tiles' rays meet of them (`beams/sift.wesl`,
//! `beams/split.wesl`, `beams/tiles.wesl`).
//!
//! The list of a node has room for all clusters of a slice, which are sent down at a time. All clusters make
//! one slice if the lists then take no more than [`ROOM`] bytes.

use glam::UVec2;

use super::geometry::Geometry;
use super::pyramid::Pyramid;
use super::settings::{Settings, TOUCHING};
use super::source::Source;
use super::tally::Tally;
use super::tile::Tile;
use crate::error::ReflectError;
use crate::gpu::{
    Gpu, Kernel, Recorder, Slot, compute, compute_unset, group, layout, module, set_uniform,
    storage_zeros, uniform, view,
};
use crate::stage::variant::Variant;

/// Most bytes of the lists of nodes of 32 × 32 pixels.
pub(super) const ROOM: u64 = 64 << 20;

/// Levels of the pyramid: nodes of 32 × 32 and 128 × 128 pixels. Twins of those in `beams/node.wesl`.
const COARSE: u32 = 4;
const TOP: u32 = 6;

/// Pixels along the side of a tile. Twin of `TILE` in `beams/node.wesl`.
pub(super) const TILE: u32 = 8;

/// Boxes grow by this share of the scene's extent: more than single precision rounds.
pub(super) const WIDER: f32 = 4e-6;

/// Bytes of a `Plan`, of a `Part`, of the `Parts` of a tile (`beams/plan.wesl`), of what a part met, and of
/// what it counts.
const PLAN: u64 = 20;
const PART: u64 = 12;
const PARTS: u64 = 8;
const HITS: u64 = 16 * (TILE * TILE) as u64;
const COUNTS: u64 = 20;

/// Clusters that are sent down at a time.
struct Slice {
    first: u32,
    count: u32,
    settings: wgpu::Buffer,
    /// Group 2: pyramid and settings.
    nodes: wgpu::BindGroup,
    plan: wgpu::Buffer,
    /// What each part took.
    counts: wgpu::Buffer,
    top: wgpu::BindGroup,
    coarse: wgpu::BindGroup,
    split: wgpu::BindGroup,
    tiles: wgpu::BindGroup,
}

/// Kernels of one variant.
struct Kernels {
    top: Kernel,
    coarse: Kernel,
    tiles: Kernel,
}

/// Lists, kernels and slices.
pub(super) struct Lists {
    plain: Kernels,
    counting: Kernels,
    split: Kernel,
    /// By reflection, by slice.
    slices: Vec<Vec<Slice>>,
    size: [u32; 2],
    /// Nodes in x and y: 128 × 128 and 32 × 32 pixels.
    nodes: [[u32; 2]; 2],
    tile_count: u32,
    room: u32,
    /// Node tests of each of those nodes.
    tests: [wgpu::Buffer; 2],
    /// By tile, which parts it is split into.
    pub(super) parts_of_tiles: wgpu::Buffer,
    /// Of each part and thread, what it met.
    pub(super) hits: wgpu::Buffer,
    bytes: u64,
}

/// What lists are to be: pixels along the side of a leaf, most bytes of the lists of large nodes, and how often
/// a path is reflected.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wanted {
    pub(super) tile: Tile,
    pub(super) room: u64,
    pub(super) reflections: u32,
}

impl Lists {
    /// `extent`: of all that rays may meet, world units.
    ///
    /// # Errors
    /// Shaders that do not link: a bug. What the device cannot hold it notes itself.
    pub(super) fn new(
        gpu: &Gpu,
        source: &Source,
        (pyramid, geometry): (&Pyramid, &Geometry),
        extent: f32,
        wanted: Wanted,
    ) -> Result<Self, ReflectError> {
        let size = source.size;
        let nodes = [TOP, COARSE].map(|level| pyramid.nodes(level));
        let [top_nodes, coarse_nodes] = nodes.map(|[x, y]| u64::from(x) * u64::from(y));
        let clusters = geometry.clusters();
        let limit = gpu.device.limits().max_storage_buffer_binding_size;
        let fitting =
            (wanted.room.min(limit) / (4 * coarse_nodes)).clamp(1, u64::from(clusters.max(1)));
        let fitting = fitting as u32;
        let tile_count = tiles(size).element_product();
        let parts = 2 * u64::from(tile_count);
        let list = |nodes: u64| storage_zeros(gpu, 4 * nodes * u64::from(fitting));
        let counts = |nodes: u64| storage_zeros(gpu, 4 * nodes);
        let (top_list, top_counts) = (list(top_nodes), counts(top_nodes));
        let (coarse_list, coarse_counts) = (list(coarse_nodes), counts(coarse_nodes));
        let tests = [top_nodes, coarse_nodes].map(counts);
        let parts_list = storage_zeros(gpu, PART * parts);
        let parts_of_tiles = storage_zeros(gpu, PARTS * u64::from(tile_count));
        let hits = storage_zeros(gpu, HITS * parts);
        gpu.check()?;
        let nothing = storage_zeros(gpu, 0);

        use Slot::{Read, Texture, Uniform, Write};
        let nodes_layout = layout(gpu, "rays", &[Texture, Texture, Texture, Uniform]);
        let sift_slots = [Texture, Read, Read, Write, Write, Write, Write];
        let sift_layout = layout(gpu, "sift", &sift_slots);
        let split_layout = layout(gpu, "split", &[Read, Write, Write, Write]);
        let tiles_slots = [Texture, Texture, Texture, Read, Read, Read, Write, Write];
        let tiles_layout = layout(gpu, "tiles", &tiles_slots);
        let leaves = match wanted.tile {
            Tile::Two => None,
            Tile::Four => Some("tile4"),
            Tile::Eight => Some("tile8"),
        };
        let kernels = |count: Option<&'static str>| -> Result<Kernels, ReflectError> {
            let count: Vec<_> = count.into_iter().collect();
            let features = count.iter().copied().chain(leaves);
            let features: Vec<_> = features.chain(source.feature).collect();
            let sift = module(gpu, "beams/sift", &count)?;
            let tiles = module(gpu, "beams/tiles", &features)?;
            let layouts = [None, None, Some(&nodes_layout), Some(&sift_layout)];
            let [view, rays] = source.layouts();
            let tiles_layouts = [view, rays, Some(&nodes_layout), Some(&tiles_layout)];
            Ok(Kernels {
                top: compute_unset(gpu, &sift, "top", &layouts),
                coarse: compute_unset(gpu, &sift, "coarse", &layouts),
                tiles: compute_unset(gpu, &tiles, "tiles", &tiles_layouts),
            })
        };
        let split_module = module(gpu, "beams/split", &[])?;
        let split_layouts = [None, None, Some(&nodes_layout), Some(&split_layout)];

        let views = pyramid.views();
        let slice = |first: u32, is_first: bool| {
            let count = fitting.min(clusters - first);
            let values = settings((size, extent), geometry, [first, count, fitting], is_first);
            let settings = uniform(gpu, &values);
            let [low, high, least] = views.each_ref().map(wgpu::BindingResource::TextureView);
            let nodes = [low, high, least, settings.as_entire_binding()];
            let plan = storage_zeros(gpu, PLAN);
            let counts = storage_zeros(gpu, COUNTS * parts);
            let images = [&geometry.cluster_boxes, &geometry.boxes, &geometry.corners].map(view);
            let images = images.each_ref().map(wgpu::BindingResource::TextureView);
            let [clusters, boxes, corners] = images;
            let whole = wgpu::Buffer::as_entire_binding;
            let top = [
                clusters.clone(),
                whole(&nothing),
                whole(&nothing),
                whole(&top_list),
                whole(&top_counts),
                whole(&plan),
                whole(&tests[0]),
            ];
            let coarse = [
                clusters.clone(),
                whole(&top_list),
                whole(&top_counts),
                whole(&coarse_list),
                whole(&coarse_counts),
                whole(&plan),
                whole(&tests[1]),
            ];
            let split = [
                whole(&coarse_counts),
                whole(&plan),
                whole(&parts_list),
                whole(&parts_of_tiles),
            ];
            let tiles = [
                clusters,
                boxes,
                corners,
                whole(&coarse_list),
                whole(&parts_list),
                whole(&plan),
                whole(&hits),
                whole(&counts),
            ];
            Slice {
                first,
                count,
                nodes: group(gpu, &nodes_layout, &nodes),
                top: group(gpu, &sift_layout, &top),
                coarse: group(gpu, &sift_layout, &coarse),
                split: group(gpu, &split_layout, &split),
                tiles: group(gpu, &tiles_layout, &tiles),
                settings,
                plan,
                counts,
            }
        };
        let slices = (0..wanted.reflections).map(|reflection| {
            let firsts = (0..clusters.max(1)).step_by(fitting as usize);
            let slices = firsts.map(|first| slice(first, reflection == 0 && first == 0));
            slices.collect()
        });
        let lists = [&top_list, &coarse_list, &top_counts, &coarse_counts];
        let buffers = lists
            .into_iter()
            .chain([&parts_list, &parts_of_tiles, &hits]);
        Ok(Self {
            plain: kernels(None)?,
            counting: kernels(Some("count"))?,
            split: compute(gpu, &split_module, "split", &split_layouts),
            slices: slices.collect(),
            size,
            nodes,
            tile_count,
            room: fitting,
            bytes: buffers.map(wgpu::Buffer::size).sum(),
            tests,
            parts_of_tiles,
            hits,
        })
    }

    /// In how many slices the clusters are sent down.
    pub(super) fn slices(&self) -> usize {
        self.slices[0].len()
    }

    /// Takes over how large the scene is now.
    pub(super) fn update(&self, gpu: &Gpu, extent: f32, geometry: &Geometry) {
        for (reflection, slices) in self.slices.iter().enumerate() {
            for slice in slices {
                let is_first = reflection == 0 && slice.first == 0;
                let part = [slice.first, slice.count, self.room];
                let values = settings((self.size, extent), geometry, part, is_first);
                set_uniform(gpu, &slice.settings, &values);
            }
        }
    }

    /// Records the passes `sift` and `tiles` for a slice, for the rays after so many reflections of each path.
    pub(super) fn record(
        &self,
        frame: &mut Recorder<'_>,
        source: &Source,
        (reflections, slice): (usize, usize),
        variant: Variant,
    ) {
        let kernels = match variant {
            Variant::AllLayers => &self.counting,
            Variant::Color => &self.plain,
        };
        let slice = &self.slices[reflections][slice];
        frame.compute("sift", |pass| {
            pass.set_bind_group(2, &slice.nodes, &[]);
            let levels = [(&kernels.top, &slice.top), (&kernels.coarse, &slice.coarse)];
            for ((kernel, own), [x, y]) in levels.into_iter().zip(self.nodes) {
                pass.set_pipeline(kernel);
                pass.set_bind_group(3, own, &[]);
                pass.dispatch_workgroups(x, y, 1);
            }
            pass.set_pipeline(&self.split);
            pass.set_bind_group(3, &slice.split, &[]);
            pass.dispatch_workgroups(self.split.groups(self.tile_count), 1, 1);
        });
        frame.compute("tiles", |pass| {
            pass.set_pipeline(&kernels.tiles);
            source.set(pass, reflections);
            pass.set_bind_group(2, &slice.nodes, &[]);
            pass.set_bind_group(3, &slice.tiles, &[]);
            pass.dispatch_workgroups_indirect(&slice.plan, 0);
        });
    }

    /// What the last frame took; it was rendered in [`Variant::AllLayers`].
    pub(super) fn tally(&self, gpu: &Gpu) -> Tally {
        let words = |buffer: &wgpu::Buffer| -> Vec<u32> {
            bytemuck::pod_collect_to_vec(&gpu.read_buffer(buffer))
        };
        let mut tally = Tally {
            bytes: self.bytes,
            ..Tally::default()
        };
        for ([x, y], tests) in self.nodes.iter().zip(&self.tests) {
            let tests = words(tests).into_iter().take((x * y) as usize);
            tally.cluster_tests += tests.map(u64::from).sum::<u64>();
        }
        for slice in self.slices.iter().flatten() {
            let parts = words(&slice.plan)[3];
            let counts = gpu.read_buffer_part(&slice.counts, COUNTS * u64::from(parts));
            let counts: Vec<[u32; 5]> = bytemuck::pod_collect_to_vec(&counts);
            for [clusters, triangles, pairs, exact, longest] in counts {
                tally.cluster_tests += u64::from(clusters);
                tally.triangle_tests += u64::from(triangles);
                tally.pairs += u64::from(pairs);
                tally.exact += u64::from(exact);
                tally.longest = tally.longest.max(u64::from(longest));
            }
        }
        tally
    }
}

/// Tiles of the image in x and y.
fn tiles(size: [u32; 2]) -> UVec2 {
    UVec2::from_array(size.map(|side| side.div_ceil(TILE)))
}

/// For a slice: its first cluster, its clusters, and how many a list has room for; whether it is the first of
/// the frame.
fn settings(
    (size, extent): ([u32; 2], f32),
    geometry: &Geometry,
    [first, count, room]: [u32; 3],
    is_first: bool,
) -> Settings {
    Settings {
        wider: WIDER * extent,
        tiles: tiles(size),
        triangles: geometry.triangles,
        first_cluster: first,
        cluster_count: count,
        room,
        is_first: u32::from(is_first),
        mirror_triangles: geometry.mirror_triangles,
        touching: TOUCHING * extent,
    }
}
