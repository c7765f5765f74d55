//! glTF 2 as JSON or binary: the meshes of the default scene, placed by its nodes, with base colours and
//! cameras. Roughness and metalness are taken as numbers; a texture of them is not looked at.

use std::borrow::Cow;
use std::path::Path;

use glam::{DMat4, DQuat, DVec3, Vec2, Vec3};
use gltf::json;
use gltf::json::mesh::{Mode, Semantic};
use gltf::json::validation::Checked;

use super::accessors::{Numbers, Resource, Source, resource};
use super::parts::{Model, ModelCamera, Part, Surface, Triangles};
use crate::SceneError;
use crate::loading::Loading;
use crate::picture::PictureSource;
use crate::text::at_line;

/// Extensions that change nothing that is taken over, or that are understood.
const UNDERSTOOD: [&str; 3] = [
    "KHR_materials_unlit",
    "KHR_texture_transform",
    "KHR_mesh_quantization",
];

/// First bytes of a binary file.
const MAGIC: &[u8] = b"glTF";

/// Reads all meshes, of which there are to be so many copies.
pub(super) fn read(path: &Path, copies: usize, loading: &Loading) -> Result<Model, SceneError> {
    let whole = |message: String| SceneError::File {
        file: path.display().to_string(),
        message,
    };
    let bytes = std::fs::read(path).map_err(|error| whole(format!("cannot be read: {error}")))?;
    let (text, inside) = match bytes.starts_with(MAGIC) {
        true => {
            let glb = gltf::binary::Glb::from_slice(&bytes);
            let glb = glb.map_err(|error| whole(format!("is no binary glTF: {error}")))?;
            (glb.json, glb.bin)
        }
        false => (Cow::Borrowed(bytes.as_slice()), None),
    };
    let root: json::Root = json::deserialize::from_slice(&text)
        .map_err(|error| at_line(path, error.line().max(1), format!("is no glTF 2: {error}")))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut reader = Reader {
        source: Source::read(&root, folder, inside.as_deref()).map_err(whole)?,
        copies,
        loading,
        model: Model::default(),
    };
    reader.read().map_err(whole)?;
    Ok(reader.model)
}

struct Reader<'f> {
    source: Source<'f>,
    copies: usize,
    loading: &'f Loading,
    model: Model,
}

/// What is known of a file's extensions and other matters, before its nodes.
impl Reader<'_> {
    fn read(&mut self) -> Result<(), String> {
        let root = self.source.root;
        if !root.asset.version.starts_with('2') {
            let version = &root.asset.version;
            return Err(format!("is glTF {version}: glTF 2 is read"));
        }
        let unknown = |names: &[String]| -> Vec<String> {
            let unknown = names
                .iter()
                .filter(|name| !UNDERSTOOD.contains(&name.as_str()));
            unknown.cloned().collect()
        };
        if let Some(name) = unknown(&root.extensions_required).first() {
            return Err(format!(
                "requires the extension {name}, which is not understood: save it without"
            ));
        }
        for name in unknown(&root.extensions_used) {
            self.leave_out(format!("extension {name}"));
        }
        let scene = match root.scene {
            Some(index) => Some(root.get(index).ok_or("its `scene` is none of its scenes")?),
            None => root.scenes.first(),
        };
        for other in &root.scenes {
            if scene.is_some_and(|scene| !std::ptr::eq(other, scene)) {
                let name = other.name.as_deref().unwrap_or_default();
                self.leave_out(format!("scene `{name}`, which is not the default one"));
            }
        }
        let tops: Vec<usize> = match scene {
            Some(scene) => scene.nodes.iter().map(|node| node.value()).collect(),
            // Without a scene all nodes are shown that are below none.
            None => {
                let below: Vec<usize> = (root.nodes.iter())
                    .flat_map(|node| node.children.iter().flatten())
                    .map(|child| child.value())
                    .collect();
                (0..root.nodes.len())
                    .filter(|node| !below.contains(node))
                    .collect()
            }
        };
        for animation in &root.animations {
            let name = animation.name.as_deref().unwrap_or_default();
            self.leave_out(format!("animation `{name}`"));
        }
        let mut seen = vec![false; root.nodes.len()];
        let mut open: Vec<(usize, DMat4)> = tops
            .into_iter()
            .rev()
            .map(|node| (node, DMat4::IDENTITY))
            .collect();
        while let Some((number, above)) = open.pop() {
            let node = root.nodes.get(number);
            let node = node.ok_or_else(|| format!("there is no node {number}"))?;
            if std::mem::replace(&mut seen[number], true) {
                return Err(format!("node {number} is below two nodes, or below itself"));
            }
            let matrix = above * placement(node);
            let children = node.children.iter().flatten().rev();
            open.extend(children.map(|child| (child.value(), matrix)));
            self.node(number, node, &matrix)?;
        }
        Ok(())
    }

    fn leave_out(&mut self, what: String) {
        self.model.left_out.push(what);
    }

    fn node(&mut self, number: usize, node: &json::Node, matrix: &DMat4) -> Result<(), String> {
        let root = self.source.root;
        let name = match &node.name {
            Some(name) => name.clone(),
            None => format!("node {number}"),
        };
        if let Some(index) = node.camera {
            let camera = root.get(index);
            let camera =
                camera.ok_or_else(|| format!("{name}: its camera is none of the file's"))?;
            match &camera.perspective {
                Some(lens) => self.model.cameras.push(ModelCamera {
                    name: name.clone(),
                    eye: matrix.transform_point3(DVec3::ZERO),
                    forward: matrix.transform_vector3(-DVec3::Z).normalize_or(-DVec3::Z),
                    up: matrix.transform_vector3(DVec3::Y).normalize_or(DVec3::Y),
                    fov_y: f64::from(lens.yfov).to_degrees(),
                    aspect: lens.aspect_ratio.map(f64::from),
                }),
                None => self.leave_out(format!("camera `{name}`, which has no perspective")),
            }
        }
        let Some(index) = node.mesh else {
            return Ok(());
        };
        let mesh = root.get(index);
        let mesh = mesh.ok_or_else(|| format!("{name}: its mesh is none of the file's"))?;
        if node.skin.is_some() {
            self.leave_out(format!("the skin of `{name}`: it stands as it was made"));
        }
        if !matrix.is_finite() {
            return Err(format!("{name}: its transform is not finite"));
        }
        let several = mesh.primitives.len() > 1;
        for (place, primitive) in mesh.primitives.iter().enumerate() {
            let of = match several {
                true => format!("{name}, primitive {place}"),
                false => name.clone(),
            };
            let Some(mut part) = self
                .primitive(&of, primitive)
                .map_err(|message| format!("{of}: {message}"))?
            else {
                continue;
            };
            part.mesh.transform(matrix);
            part.name = match several && !part.surface.name.is_empty() {
                true => format!("{name} {}", part.surface.name),
                false => of,
            };
            self.model.parts.push(part);
        }
        Ok(())
    }

    /// A mesh in its own space; `None` of what is no surface.
    fn primitive(
        &mut self,
        name: &str,
        primitive: &json::mesh::Primitive,
    ) -> Result<Option<Part>, String> {
        let mode = match primitive.mode {
            Checked::Valid(mode) => mode,
            Checked::Invalid => return Err("its mode is none that there is".to_owned()),
        };
        if !matches!(
            mode,
            Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan
        ) {
            self.leave_out(format!("`{name}`: points or lines"));
            return Ok(None);
        }
        if primitive.targets.is_some() {
            self.leave_out(format!("the morph targets of `{name}`"));
        }
        let surface = self.surface(name, primitive.material)?;
        let read = |semantic: Semantic| -> Result<Option<Numbers>, String> {
            let index = primitive.attributes.get(&Checked::Valid(semantic));
            index.map(|index| self.source.numbers(*index)).transpose()
        };
        let positions = read(Semantic::Positions)?;
        let Some(positions) = positions else {
            self.leave_out(format!("`{name}`: it has no positions"));
            return Ok(None);
        };
        let positions = vectors(&positions)?;
        if let Some(index) = positions.iter().position(|at| !at.is_finite()) {
            return Err(format!("vertex {index} is not finite"));
        }
        let corners: Vec<u32> = match primitive.indices {
            None => (0..positions.len() as u32).collect(),
            Some(index) => {
                let numbers = self.source.numbers(index)?;
                numbers.values.iter().map(|index| *index as u32).collect()
            }
        };
        if let Some(index) = corners
            .iter()
            .find(|index| **index as usize >= positions.len())
        {
            return Err(format!(
                "has no vertex {index}: there are {}",
                positions.len()
            ));
        }
        let triangles = assembled(&corners, mode);
        self.loading
            .triangles(triangles.len() as u64, self.copies)?;
        let at = |all: &[DVec3]| -> Result<Vec<[DVec3; 3]>, String> {
            if all.len() < positions.len() {
                return Err(format!(
                    "has {} values for {} vertices",
                    all.len(),
                    positions.len()
                ));
            }
            let of = |three: &[u32; 3]| three.map(|index| all[index as usize]);
            Ok(triangles.iter().map(of).collect())
        };
        let normals = match read(Semantic::Normals)? {
            Some(normals) => at(&vectors(&normals)?)?,
            None => Vec::new(),
        };
        let uvs = match read(Semantic::TexCoords(surface.set))? {
            Some(uvs) => {
                let place = |uv: DVec3| {
                    let Vec2 { x, y } = surface.place(uv);
                    // v = 0 is the top row of the picture there, and the bottom one here.
                    DVec3::new(f64::from(x), 1.0 - f64::from(y), 0.0)
                };
                let uvs: Vec<DVec3> = vectors(&uvs)?.into_iter().map(place).collect();
                let flat = |three: [DVec3; 3]| three.map(|uv| uv.truncate().as_vec2());
                at(&uvs)?.into_iter().map(flat).collect()
            }
            None => Vec::new(),
        };
        let colors = read(Semantic::Colors(0))?;
        let mut surface = surface.surface;
        if surface.picture.is_some() && uvs.is_empty() {
            self.leave_out(format!(
                "the picture of `{name}`: it has no texture coordinates"
            ));
            surface.picture = None;
        }
        let colors = match colors {
            Some(_) if surface.picture.is_some() => {
                self.leave_out(format!(
                    "the vertex colours of `{name}`, which has a picture"
                ));
                Vec::new()
            }
            Some(colors) => {
                let tint = surface.color;
                let tinted =
                    |three: [DVec3; 3]| three.map(|color| (color.as_vec3() * tint).max(Vec3::ZERO));
                at(&vectors(&colors)?)?.into_iter().map(tinted).collect()
            }
            None => Vec::new(),
        };
        Ok(Some(Part {
            name: name.to_owned(),
            mesh: Triangles {
                positions,
                triangles,
                normals,
                uvs,
                colors,
            },
            surface,
        }))
    }

    fn surface(
        &mut self,
        name: &str,
        index: Option<json::Index<json::Material>>,
    ) -> Result<Placed, String> {
        let mut placed = Placed::default();
        let Some(index) = index else {
            return Ok(placed);
        };
        let material = self.source.root.get(index);
        let material = material.ok_or("its material is none of the file's")?;
        let called = match &material.name {
            Some(name) => name.clone(),
            None => format!("material {}", index.value()),
        };
        let pbr = &material.pbr_metallic_roughness;
        let [red, green, blue, _] = pbr.base_color_factor.0;
        let by_texture = pbr.metallic_roughness_texture.is_some();
        if by_texture {
            self.leave_out(format!(
                "the texture of `{called}` for metalness and roughness, on `{name}`"
            ));
        }
        let what = [
            (material.normal_texture.is_some(), "normal map"),
            (material.emissive_texture.is_some(), "texture of light"),
        ];
        for (_, what) in what.into_iter().filter(|(has, _)| *has) {
            self.leave_out(format!("the {what} of `{called}`, on `{name}`"));
        }
        if let Some(info) = &pbr.base_color_texture {
            let source = self
                .picture(info.index)
                .map_err(|message| format!("{called}: {message}"))?;
            let transform = (info.extensions.as_ref())
                .and_then(|extensions| extensions.texture_transform.as_ref());
            placed.set = transform
                .and_then(|transform| transform.tex_coord)
                .unwrap_or(info.tex_coord);
            if let Some(transform) = transform {
                placed.offset = Vec2::from(transform.offset.0);
                placed.scale = Vec2::from(transform.scale.0);
                placed.rotation = transform.rotation.0;
            }
            placed.surface.picture = Some(source);
        }
        placed.surface = Surface {
            name: called,
            color: Vec3::new(red, green, blue).max(Vec3::ZERO),
            picture: placed.surface.picture,
            metal: pbr.metallic_factor.0 >= 0.5 && !by_texture,
            roughness: f64::from(pbr.roughness_factor.0),
        };
        Ok(placed)
    }

    /// The picture of a texture.
    fn picture(&self, index: json::Index<json::Texture>) -> Result<PictureSource, String> {
        let root = self.source.root;
        let texture = root.get(index).ok_or("its texture is none of the file's")?;
        let image = root.get(texture.source);
        let image =
            image.ok_or("its picture is none of the file's, or of a kind that is not read")?;
        match (&image.uri, image.buffer_view) {
            (Some(uri), _) => Ok(match resource(uri, self.source.folder)? {
                Resource::Bytes(bytes) => PictureSource::Bytes(bytes),
                Resource::File(path) => PictureSource::File(path),
            }),
            (None, Some(view)) => Ok(PictureSource::Bytes(self.source.view(view)?.to_vec())),
            (None, None) => Err("a picture has neither `uri` nor `bufferView`".to_owned()),
        }
    }
}

/// A material, and how its picture lies on meshes.
struct Placed {
    surface: Surface,
    /// Which texture coordinates of a mesh are meant.
    set: u32,
    offset: Vec2,
    /// Radians.
    rotation: f32,
    scale: Vec2,
}

impl Default for Placed {
    /// What a mesh without a material has: white, as rough as can be.
    fn default() -> Self {
        Self {
            surface: Surface {
                color: Vec3::ONE,
                ..Surface::default()
            },
            set: 0,
            offset: Vec2::ZERO,
            rotation: 0.0,
            scale: Vec2::ONE,
        }
    }
}

impl Placed {
    /// Texture coordinates as `KHR_texture_transform` says: scaled, rotated, moved.
    fn place(&self, uv: DVec3) -> Vec2 {
        let uv = uv.truncate().as_vec2();
        if self.rotation == 0.0 {
            return self.scale * uv + self.offset;
        }
        let (sin, cos) = self.rotation.sin_cos();
        let Vec2 { x, y } = self.scale * uv;
        Vec2::new(cos * x + sin * y, cos * y - sin * x) + self.offset
    }
}

/// World from a node's own space, as if the node had no parent.
fn placement(node: &json::Node) -> DMat4 {
    if let Some(matrix) = node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector = |numbers: [f32; 3]| DVec3::from(numbers.map(f64::from));
    let turn = node.rotation.map_or(DQuat::IDENTITY, |turn| {
        let turn = DQuat::from_array(turn.0.map(f64::from));
        match turn.length() > 0.0 && turn.is_finite() {
            true => turn.normalize(),
            false => DQuat::IDENTITY,
        }
    });
    DMat4::from_scale_rotation_translation(
        node.scale.map_or(DVec3::ONE, vector),
        turn,
        node.translation.map_or(DVec3::ZERO, vector),
    )
}

/// Rows of two or more numbers; a missing third one is 0.
fn vectors(numbers: &Numbers) -> Result<Vec<DVec3>, String> {
    if numbers.width < 2 {
        return Err("single numbers stand where vectors should".to_owned());
    }
    let rows = numbers.values.chunks_exact(numbers.width);
    let vector = |row: &[f64]| DVec3::new(row[0], row[1], row.get(2).copied().unwrap_or(0.0));
    Ok(rows.map(vector).collect())
}

/// Triangles of lists, strips and fans.
fn assembled(corners: &[u32], mode: Mode) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => corners
            .windows(3)
            .enumerate()
            .map(|(number, three)| match number % 2 {
                0 => [three[0], three[1], three[2]],
                _ => [three[1], three[0], three[2]],
            })
            .collect(),
        Mode::TriangleFan => match corners {
            [first, rest @ ..] => rest
                .windows(2)
                .map(|two| [*first, two[0], two[1]])
                .collect(),
            [] => Vec::new(),
        },
        _ => corners.as_chunks::<3>().0.to_vec(),
    }
}
