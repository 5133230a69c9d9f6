//! Renders a still of a scene with the crate `cinesplat-render` alone: `still-example room.spz still.ppm`.

use cinesplat_render::geometry::{Camera, Intrinsics, Pose};
use cinesplat_render::scene::{LoadOptions, load};
use cinesplat_render::{RenderSettings, Renderer};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, output] = arguments.as_slice() else { return Err("usage: still-example SCENE OUT.ppm".into()) };
    let scene = load(input.as_ref(), &LoadOptions::default())?;
    let forward = scene.up.any_orthonormal_vector();
    let eye = scene.bounds().center() - forward * 0.5 * scene.bounds().size();
    let intrinsics = Intrinsics::from_fov_y(640, 360, 1.0);
    let camera = Camera { pose: Pose::facing(eye, forward, scene.up, None), intrinsics };
    let frame = Renderer::new(&scene.gaussians).render(&camera, &RenderSettings::for_scene(&scene))?;
    let header = format!("P6 {} {} 255\n", frame.width, frame.height);
    std::fs::write(output, [header.as_bytes(), &frame.to_rgb8()].concat())?;
    Ok(())
}
