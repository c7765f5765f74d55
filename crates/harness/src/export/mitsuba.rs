//! A scene for Mitsuba 3: `scene.xml`, meshes and textures beside it, and `scene.json`, which
//! says which shape belongs to which of our ids.
//!
//! How a scene of ours is expressed in Mitsuba's terms:
//! - An unlit surface is an area emitter whose radiance is its colour, with a BSDF that reflects
//!   nothing. Emitters are black from behind: see `sides.rs`.
//! - A mirror is a `conductor` of material `none`; it is black from behind like ours.
//! - Sphere and rectangle are Mitsuba's own. An ellipsoid is an instance of a sphere: its plugin
//!   `ellipsoids` is a hundred times less exact where it is thin and far. Every other curved mirror
//!   is a fine mesh with the exact normals.
//! - Meshes carry world-space positions, and normals only where those are for shading.
//! - One sample a pixel is a ray through its centre; more (square numbers) are a regular grid.
//! - Reflected rays always see mirrors: truth `full`.

use std::fmt::Write as _;
use std::path::Path;

use catoptric_frame::{Frame, Image};
use catoptric_scene::shape::Primitive;
use catoptric_scene::{Background, Fov, Mesh, Mirror, Paint, Scene, Texture};
use glam::{DMat3, DVec3, Vec2, Vec3};
use serde_json::json;

use crate::output::Bundle;

use super::ply::Ply;
use super::sides::{Viewpoints, visible};

/// What Mitsuba loads.
pub const SCENE_FILE: &str = "scene.xml";
/// Ids, names and settings, for the script that renders.
pub const IDS_FILE: &str = "scene.json";

/// Rows of the picture of a gradient. Odd, so that one is the horizon, where the gradient bends;
/// between rows the error is at most (π / 1024)² / 8, times the contrast: 1.2e-6.
const GRADIENT_ROWS: u32 = 1025;

/// Near clipping plane, in distances from eye to target: Mitsuba's rays start on it.
const NEAR: f64 = 1e-3;
/// Far clipping plane, likewise.
const FAR: f64 = 1e5;

/// Writes a scene, its meshes and textures, all of them at once: an earlier export is kept until
/// then.
///
/// # Errors
/// The folder cannot be written into.
pub fn write(scene: &Scene, bounces: u32, folder: &Path) -> anyhow::Result<()> {
    let mut writer = Writer {
        folder,
        files: Bundle::default(),
        xml: String::new(),
        ids: Vec::new(),
        textures: 0,
    };
    writer.head(scene, bounces);
    writer.background(&scene.background)?;
    let viewpoints = Viewpoints::new(scene);
    for (index, object) in scene.objects.iter().enumerate() {
        let shapes = writer.object(scene.object_id(index), &object.mesh, &viewpoints)?;
        writer.name(scene.object_id(index), &object.name, "object", shapes);
    }
    for (index, mirror) in scene.mirrors.iter().enumerate() {
        let id = scene.mirror_id(index);
        let shape = format!("mirror_{id}");
        writer.mirror(&shape, mirror);
        writer.name(id, &mirror.name, "mirror", vec![shape]);
    }
    writer.xml += "</scene>\n";
    let ids = json!({
        "format": 1,
        "scene": scene.name,
        "scene_hash": scene.hash,
        "resolution": scene.camera.resolution,
        "bounces": bounces,
        "ids": writer.ids,
    });
    let mut files = writer.files;
    files.add(IDS_FILE, format!("{ids:#}\n").into_bytes());
    files.add(SCENE_FILE, writer.xml.into_bytes());
    files.put(folder)
}

struct Writer<'f> {
    folder: &'f Path,
    files: Bundle,
    xml: String,
    ids: Vec<serde_json::Value>,
    textures: u32,
}

impl Writer<'_> {
    fn name(&mut self, id: u32, name: &str, kind: &str, shapes: Vec<String>) {
        let entry = json!({ "id": id, "name": name, "kind": kind, "shapes": shapes });
        self.ids.push(entry);
    }

    /// Parameters that a loader may replace, the integrator, the camera.
    fn head(&mut self, scene: &Scene, bounces: u32) {
        let camera = &scene.camera;
        let [width, height] = camera.resolution;
        let (axis, degrees) = match camera.fov {
            Fov::X(degrees) => ("x", degrees),
            Fov::Y(degrees) => ("y", degrees),
        };
        let distance = camera.eye.distance(camera.target);
        let (near, far) = (distance * NEAR, distance * FAR);
        let [eye, target, up] = [camera.eye, camera.target, camera.up].map(vector);
        let depth = bounces + 1;
        self.xml = format!(
            r#"<!-- Reflections up to max_depth - 1 of them; 1 sample a pixel is its centre. -->
<scene version="3.0.0">
    <default name="width" value="{width}"/>
    <default name="height" value="{height}"/>
    <default name="samples" value="1"/>
    <default name="max_depth" value="{depth}"/>

    <integrator type="path">
        <integer name="max_depth" value="$max_depth"/>
        <integer name="rr_depth" value="1000000"/>
    </integrator>

    <sensor type="perspective" id="camera">
        <transform name="to_world">
            <lookat origin="{eye}" target="{target}" up="{up}"/>
        </transform>
        <float name="fov" value="{degrees}"/>
        <string name="fov_axis" value="{axis}"/>
        <float name="near_clip" value="{near}"/>
        <float name="far_clip" value="{far}"/>
        <sampler type="stratified">
            <integer name="sample_count" value="$samples"/>
            <boolean name="jitter" value="false"/>
        </sampler>
        <film type="hdrfilm">
            <integer name="width" value="$width"/>
            <integer name="height" value="$height"/>
            <string name="pixel_format" value="rgb"/>
            <string name="component_format" value="float32"/>
            <rfilter type="box"/>
        </film>
    </sensor>
"#
        );
    }

    fn background(&mut self, background: &Background) -> anyhow::Result<()> {
        let emitter = match *background {
            Background::Color(color) => constant(color),
            Background::Gradient {
                zenith,
                horizon,
                nadir,
            } if zenith == horizon && nadir == horizon => constant(horizon),
            Background::Gradient {
                zenith,
                horizon,
                nadir,
            } => {
                // Mitsuba places the first and the last row exactly at the poles.
                let row = |row: u32| {
                    let polar =
                        f64::from(row) / f64::from(GRADIENT_ROWS - 1) * std::f64::consts::PI;
                    let height = polar.cos();
                    let towards = if height >= 0.0 { zenith } else { nadir };
                    horizon
                        .as_dvec3()
                        .lerp(towards.as_dvec3(), height.abs())
                        .as_vec3()
                };
                let texels = (0..GRADIENT_ROWS).flat_map(|at| [row(at); 4]).collect();
                let file = self.texture([4, GRADIENT_ROWS], texels)?;
                format!(
                    r#"
    <emitter type="envmap">
        <string name="filename" value="{file}"/>
    </emitter>
"#
                )
            }
        };
        self.xml += &emitter;
        Ok(())
    }

    /// The shapes of an object: one a material that has triangles. Vertices alone show nothing.
    fn object(
        &mut self,
        id: u32,
        mesh: &Mesh,
        viewpoints: &Viewpoints,
    ) -> anyhow::Result<Vec<String>> {
        let faces = visible(mesh, viewpoints);
        let mut shapes = Vec::new();
        for (number, material) in mesh.materials.iter().enumerate() {
            let paint = &material.paint;
            let mut ply = Ply::new(match paint {
                Paint::Color(_) => &["x", "y", "z"],
                Paint::Checker { .. } | Paint::Texture { .. } => &["x", "y", "z", "u", "v"],
                Paint::Vertex => &["x", "y", "z", "r", "g", "b"],
            });
            let of_material = faces
                .iter()
                .filter(|(index, ..)| mesh.material[*index] as usize == number);
            for &(index, positions, flipped) in of_material {
                let values = attributes(mesh, paint, index, flipped);
                let corner = |corner: usize| {
                    let mut row = positions[corner].to_array().to_vec();
                    row.extend_from_slice(&values[corner]);
                    row
                };
                let [a, b, c] = [0, 1, 2].map(corner);
                ply.triangle([&a, &b, &c]);
            }
            if ply.is_empty() {
                continue;
            }
            let shape = format!("object_{id}_{number}");
            let file = self.mesh(&shape, &ply);
            let radiance = self.radiance(paint)?;
            let _ = write!(
                self.xml,
                r#"
    <shape type="ply" id="{shape}">
        <string name="filename" value="{file}"/>
        <boolean name="face_normals" value="true"/>
        <emitter type="area">
{radiance}
        </emitter>
        <bsdf type="conductor">
            <string name="material" value="none"/>
            <rgb name="specular_reflectance" value="0"/>
        </bsdf>
    </shape>
"#
            );
            shapes.push(shape);
        }
        Ok(shapes)
    }

    /// The colour of a surface as what it radiates.
    fn radiance(&mut self, paint: &Paint) -> anyhow::Result<String> {
        Ok(match paint {
            Paint::Color(color) => {
                format!(
                    r#"            <rgb name="radiance" value="{}"/>"#,
                    rgb(*color)
                )
            }
            Paint::Vertex => r#"            <texture name="radiance" type="mesh_attribute">
                <string name="name" value="vertex_color"/>
            </texture>"#
                .to_owned(),
            Paint::Checker { a, b, cells } => {
                let file = self.texture([2, 2], vec![*a, *b, *b, *a])?;
                let scale = f64::from(*cells) / 2.0;
                format!(
                    r#"            <texture name="radiance" type="bitmap">
                <string name="filename" value="{file}"/>
                <boolean name="raw" value="true"/>
                <string name="filter_type" value="nearest"/>
                <string name="wrap_mode" value="repeat"/>
                <transform name="to_uv">
                    <scale x="{scale}" y="{scale}"/>
                </transform>
            </texture>"#
                )
            }
            Paint::Texture { tint, image } => {
                let file =
                    self.texture([image.width(), image.height()], from_bottom(image, *tint))?;
                format!(
                    r#"            <texture name="radiance" type="bitmap">
                <string name="filename" value="{file}"/>
                <boolean name="raw" value="true"/>
                <string name="filter_type" value="bilinear"/>
                <string name="wrap_mode" value="repeat"/>
            </texture>"#
                )
            }
        })
    }

    fn mirror(&mut self, shape: &str, mirror: &Mirror) {
        let (plugin, keys) = match mirror.shape.primitive() {
            Some(Primitive::Sphere { center, radius }) => {
                let [x, y, z] = center.to_array();
                let keys = format!(
                    r#"        <point name="center" x="{x}" y="{y}" z="{z}"/>
        <float name="radius" value="{radius}"/>"#
                );
                ("sphere", keys)
            }
            Some(Primitive::Ellipsoid { center, axes }) => {
                let matrix = matrix(axes, center);
                let _ = write!(
                    self.xml,
                    r#"
    <shape type="shapegroup" id="group_{shape}">
        <shape type="sphere" id="{shape}">
            <bsdf type="conductor">
                <string name="material" value="none"/>
            </bsdf>
        </shape>
    </shape>
    <shape type="instance" id="instance_{shape}">
        <ref id="group_{shape}"/>
{matrix}
    </shape>
"#
                );
                return;
            }
            Some(Primitive::Rectangle { center, axes }) => ("rectangle", matrix(axes, center)),
            None => {
                let mesh = mirror.shape.tessellate(mirror.shape.fine_segments());
                let mut ply = Ply::new(&["x", "y", "z", "nx", "ny", "nz"]);
                for (corners, normals) in mesh.triangles.iter().zip(&mesh.normals) {
                    let row = |corner: usize| {
                        let [x, y, z] = mesh.positions[corners[corner] as usize].to_array();
                        let [nx, ny, nz] = normals[corner].to_array();
                        [x, y, z, nx, ny, nz]
                    };
                    ply.triangle([&row(0), &row(1), &row(2)]);
                }
                let file = self.mesh(shape, &ply);
                let keys = format!(r#"        <string name="filename" value="{file}"/>"#);
                ("ply", keys)
            }
        };
        let _ = write!(
            self.xml,
            r#"
    <shape type="{plugin}" id="{shape}">
{keys}
        <bsdf type="conductor">
            <string name="material" value="none"/>
        </bsdf>
    </shape>
"#
        );
    }

    /// Adds a mesh; its path beside the scene.
    fn mesh(&mut self, name: &str, ply: &Ply) -> String {
        let file = format!("meshes/{name}.ply");
        self.files.add(file.as_str(), ply.bytes());
        file
    }

    /// Adds a linear picture, rows from the top; its path beside the scene.
    fn texture(&mut self, size: [u32; 2], texels: Vec<Vec3>) -> anyhow::Result<String> {
        let file = format!("textures/{}.exr", self.textures);
        self.textures += 1;
        let picture = Frame {
            color: Image::from_vec(size, texels),
            primary: None,
            reflected: None,
            motion: None,
            names: Vec::new(),
        };
        let bytes = picture.to_exr(&self.folder.join(&file))?;
        self.files.add(file.as_str(), bytes);
        Ok(file)
    }
}

/// What a paint needs at the three corners of a triangle.
fn attributes(mesh: &Mesh, paint: &Paint, triangle: usize, flipped: bool) -> [Vec<f32>; 3] {
    let [a, b, c] = match paint {
        Paint::Color(_) => [const { Vec::new() }; 3],
        Paint::Checker { .. } | Paint::Texture { .. } => mesh
            .uvs
            .get(triangle)
            .copied()
            .unwrap_or([Vec2::ZERO; 3])
            .map(|uv| uv.to_array().to_vec()),
        Paint::Vertex => mesh.colors[triangle].map(|color| color.to_array().to_vec()),
    };
    if flipped { [a, c, b] } else { [a, b, c] }
}

/// The texels of a texture, tinted, with the row of v = 0 first: Mitsuba's v runs down the picture.
fn from_bottom(image: &Texture, tint: Vec3) -> Vec<Vec3> {
    let width = image.width() as usize;
    let rows = (0..image.height() as usize).rev();
    rows.flat_map(|row| row * width..(row + 1) * width)
        .map(|index| tint * image.texel(index))
        .collect()
}

/// World from a shape's own axes.
fn matrix(axes: DMat3, origin: DVec3) -> String {
    let row = |row: usize| {
        let [x, y, z] = axes.row(row).to_array();
        format!("{x} {y} {z} {}", origin[row])
    };
    let rows = [0, 1, 2].map(row).join(" ");
    format!(
        r#"        <transform name="to_world">
            <matrix value="{rows} 0 0 0 1"/>
        </transform>"#
    )
}

fn constant(color: Vec3) -> String {
    format!(
        r#"
    <emitter type="constant">
        <rgb name="radiance" value="{}"/>
    </emitter>
"#,
        rgb(color)
    )
}

fn rgb(color: Vec3) -> String {
    color
        .to_array()
        .map(|channel| channel.to_string())
        .join(", ")
}

fn vector(vector: DVec3) -> String {
    vector
        .to_array()
        .map(|number| number.to_string())
        .join(", ")
}
