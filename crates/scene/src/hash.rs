//! The fingerprint of a scene: everything that influences a picture, and nothing else.

use std::fmt::Write as _;

use glam::{DVec3, Vec3};
use sha2::{Digest, Sha256};

use crate::camera::{Camera, Fov};
use crate::mesh::{Mesh, Paint};
use crate::mirror::Mirror;
use crate::{Background, Object};

/// SHA-256 in hex over camera (without the resolution), background, geometry, paints, mirrors.
pub(crate) fn hash(
    camera: &Camera,
    background: &Background,
    objects: &[Object],
    mirrors: &[Mirror],
) -> String {
    let mut hasher = Hasher(Sha256::new());
    hasher.tag("catoptric scene 1");
    for vector in [camera.eye, camera.target, camera.up] {
        hasher.vector(vector);
    }
    let (axis, degrees) = match camera.fov {
        Fov::X(degrees) => ("fov_x", degrees),
        Fov::Y(degrees) => ("fov_y", degrees),
    };
    hasher.tag(axis);
    hasher.number(degrees);
    match background {
        Background::Color(color) => {
            hasher.tag("color");
            hasher.color(*color);
        }
        Background::Gradient {
            zenith,
            horizon,
            nadir,
        } => {
            hasher.tag("gradient");
            [zenith, horizon, nadir]
                .into_iter()
                .for_each(|color| hasher.color(*color));
        }
    }
    for object in objects {
        hasher.tag("object");
        hasher.mesh(&object.mesh);
    }
    for mirror in mirrors {
        hasher.tag("mirror");
        hasher.mirror(mirror);
        if !mirror.cubemaps.is_empty() {
            hasher.tag("cubemaps");
            mirror
                .cubemaps
                .iter()
                .for_each(|center| hasher.vector(*center));
        }
        for proxy in &mirror.proxies {
            hasher.tag("proxy");
            hasher.mesh(proxy);
        }
    }
    hasher
        .0
        .finalize()
        .iter()
        .fold(String::new(), |mut hex, byte| {
            // Writing to a string does not fail.
            let _ = write!(hex, "{byte:02x}");
            hex
        })
}

struct Hasher(Sha256);

impl Hasher {
    /// A word with its length, so that neighbours cannot run together.
    fn tag(&mut self, word: &str) {
        self.0.update((word.len() as u64).to_le_bytes());
        self.0.update(word);
    }

    fn number(&mut self, number: f64) {
        self.0.update(number.to_le_bytes());
    }

    fn vector(&mut self, vector: DVec3) {
        vector
            .to_array()
            .into_iter()
            .for_each(|number| self.number(number));
    }

    fn color(&mut self, color: Vec3) {
        self.floats(color.to_array());
    }

    fn floats(&mut self, floats: impl IntoIterator<Item = f32>) {
        floats
            .into_iter()
            .for_each(|float| self.0.update(float.to_le_bytes()));
    }

    fn counts<'a>(&mut self, counts: impl IntoIterator<Item = &'a u32>) {
        counts
            .into_iter()
            .for_each(|count| self.0.update(count.to_le_bytes()));
    }

    fn mesh(&mut self, mesh: &Mesh) {
        let lengths = [
            mesh.positions.len(),
            mesh.triangles.len(),
            mesh.normals.len(),
            mesh.uvs.len(),
            mesh.colors.len(),
            mesh.materials.len(),
        ];
        lengths
            .into_iter()
            .for_each(|length| self.0.update((length as u64).to_le_bytes()));
        mesh.positions
            .iter()
            .for_each(|position| self.floats(position.to_array()));
        self.counts(mesh.triangles.as_flattened());
        mesh.normals
            .as_flattened()
            .iter()
            .for_each(|normal| self.floats(normal.to_array()));
        mesh.uvs
            .as_flattened()
            .iter()
            .for_each(|uv| self.floats(uv.to_array()));
        mesh.colors
            .as_flattened()
            .iter()
            .for_each(|color| self.color(*color));
        self.counts(&mesh.material);
        mesh.materials
            .iter()
            .for_each(|material| self.paint(&material.paint));
    }

    fn paint(&mut self, paint: &Paint) {
        match paint {
            Paint::Color(color) => {
                self.tag("color");
                self.color(*color);
            }
            Paint::Checker { a, b, cells } => {
                self.tag("checker");
                self.color(*a);
                self.color(*b);
                self.counts([cells]);
            }
            Paint::Texture { tint, image } => {
                self.tag("texture");
                self.color(*tint);
                self.counts([&image.width(), &image.height()]);
                image.texels().for_each(|texel| self.color(texel));
            }
            Paint::Vertex => self.tag("vertex"),
        }
    }

    fn mirror(&mut self, mirror: &Mirror) {
        self.counts([&mirror.tessellation]);
        self.tag(mirror.shape.name());
        mirror
            .shape
            .numbers()
            .into_iter()
            .for_each(|number| self.number(number));
        if let Some(mesh) = mirror.shape.as_mesh() {
            self.mesh(mesh);
        }
    }
}
