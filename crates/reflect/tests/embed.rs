//! The small renderer of `examples/embed.rs` shows what `beams` shows; skipped where there is no adapter, unless
//! `CATOPTRIC_REQUIRE_GPU=1`.

#[path = "../examples/embed.rs"]
#[allow(dead_code, reason = "the example's main function")]
mod example;

use catoptric_reflect::{Gpu, Prefer, embed, wgpu};
use catoptric_scene::{
    Background, Fov, LoadOptions, Material, Mesh, Paint, Scene, Shape, shape::Sphere,
};
use glam::{DVec3, Vec3};

const SIZE: [u32; 2] = [160, 120];

/// The example's scene as this project has scenes.
fn scene() -> Scene {
    let mut scene =
        catoptric_scene::open("sphere-square", &LoadOptions::default()).expect("a built-in scene");
    let (vertices, triangles) = example::triangles();
    let color = |vertex: &u32| {
        let [.., r, g, b] = vertices[*vertex as usize];
        Vec3::new(r, g, b)
    };
    scene.objects[0].mesh = Mesh {
        positions: vertices
            .iter()
            .map(|[x, y, z, ..]| Vec3::new(*x, *y, *z))
            .collect(),
        colors: triangles
            .iter()
            .map(|corners| corners.each_ref().map(color))
            .collect(),
        material: vec![0; triangles.len()],
        materials: vec![Material {
            name: "painted".to_owned(),
            paint: Paint::Vertex,
        }],
        triangles,
        ..Mesh::default()
    };
    let ([x, y, z], radius) = example::BALL;
    scene.mirrors.truncate(1);
    scene.mirrors[0].shape = Shape::from(Sphere {
        center: Vec3::new(x, y, z).as_dvec3(),
        radius: f64::from(radius),
    });
    scene.background = Background::Color(Vec3::from(example::SKY));
    let eye = Vec3::from(example::EYE).as_dvec3();
    scene.camera.eye = eye;
    scene.camera.target = eye - DVec3::Z;
    scene.camera.up = DVec3::Y;
    scene.camera.fov = Fov::Y(2.0 * f64::from(example::TANGENTS[1]).atan().to_degrees());
    scene.motion = None;
    scene
}

fn device_or_skip() -> Option<(wgpu::Device, wgpu::Queue)> {
    let device = example::device();
    let required = std::env::var("CATOPTRIC_REQUIRE_GPU").is_ok_and(|value| value == "1");
    assert!(
        device.is_some() || !required,
        "CATOPTRIC_REQUIRE_GPU=1, and there is no adapter"
    );
    device
}

#[test]
fn another_renderers_picture_is_that_of_beams() {
    let Some((device, queue)) = device_or_skip() else {
        return;
    };
    let picture = example::draw(device, queue, SIZE).expect("fits");
    let gpu = Gpu::new(None, Prefer::Software).expect("an adapter");
    let spec = catoptric_reflect::parse("beams").expect("a technique");
    let mut prepared = catoptric_reflect::prepare(&gpu, &spec, &scene(), SIZE).expect("fits");
    let frame = prepared.render().expect("renders").frame;
    let mirror = frame.primary.expect("all layers").id;
    let seen = frame.reflected.expect("all layers").id;
    let (mut pixels, mut reflecting, mut unlike) = (0, 0, 0);
    for (index, [r, g, b, _]) in picture.iter().enumerate() {
        let apart = (Vec3::new(*r, *g, *b) - frame.color.pixels()[index])
            .abs()
            .max_element();
        pixels += 1;
        reflecting += u32::from(mirror.pixels()[index] == 2 && seen.pixels()[index] == 1);
        unlike += u32::from(apart > 1e-4);
    }
    println!("{unlike} of {pixels} pixels unlike, {reflecting} show triangles in the mirror");
    assert!(reflecting > 500, "{reflecting}");
    // Edges of triangles and of the ball, which two renderers round otherwise.
    assert!(unlike <= 12, "{unlike}");
}

#[test]
fn what_does_not_fit_is_told() {
    let Some((device, queue)) = device_or_skip() else {
        return;
    };
    let texture = |width, usage| {
        device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width,
                height: 8,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage,
            view_formats: &[],
        })
    };
    let read = wgpu::TextureUsages::TEXTURE_BINDING;
    let (whole, narrow) = (texture(8, read), texture(4, read));
    let unread = texture(8, wgpu::TextureUsages::COPY_DST);
    let buffer = |size, usage| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size,
            usage,
            mapped_at_creation: false,
        })
    };
    let storage = wgpu::BufferUsages::STORAGE;
    let (vertices, short) = (buffer(36, storage), buffer(24, storage));
    let closed = buffer(36, wgpu::BufferUsages::VERTEX);
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let right = embed::Triangles {
        positions: &positions,
        indices: &[[0, 1, 2]],
        vertices: &vertices,
        offset: 0,
        stride: 12,
    };
    let message = |triangles: embed::Triangles<'_>, position: &wgpu::Texture| {
        let normal = &whole;
        let made = embed::Beams::new(
            &device,
            &queue,
            &triangles,
            embed::GBuffer { position, normal },
        );
        made.err().map(|error| error.to_string())
    };
    assert_eq!(message(right, &whole), None);
    let none = embed::Triangles {
        indices: &[],
        positions: &[],
        ..right
    };
    assert_eq!(message(none, &whole), None, "no triangles are a scene, too");
    let says = |message: Option<String>, words: &[&str]| {
        let message = message.expect("an error");
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    };
    says(message(right, &narrow), &["size", "4", "8"]);
    says(message(right, &unread), &["position", "TEXTURE_BINDING"]);
    let indices = [[0, 1, 3]];
    says(
        message(
            embed::Triangles {
                indices: &indices,
                ..right
            },
            &whole,
        ),
        &["triangle 0", "vertex 3", "3 positions"],
    );
    says(
        message(
            embed::Triangles {
                stride: 10,
                ..right
            },
            &whole,
        ),
        &["stride 10", "4"],
    );
    says(
        message(
            embed::Triangles {
                vertices: &short,
                ..right
            },
            &whole,
        ),
        &["36", "24"],
    );
    says(
        message(
            embed::Triangles {
                vertices: &closed,
                ..right
            },
            &whole,
        ),
        &["STORAGE"],
    );
}
