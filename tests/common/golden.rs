//! Pictures held against goldens, every pixel counted.
//!
//! Goldens are strict on the software Vulkan that drew them (named in `adapter.txt`), a little less so on another one,
//! and skipped on a real GPU. They guard against change; that they are right is for the oracles. `UPDATE_GOLDENS=1`
//! writes them anew.

use std::path::PathBuf;

use image::{Rgba, RgbaImage};

/// Largest difference of a channel that is no difference.
const NOISE: u8 = 2;
/// Share of pixels that may differ on another software Vulkan.
const STRAYS: f64 = 0.0005;
/// Pixels that touch each other and differ: so many are a shape, not noise.
const PATCH: usize = 8;

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/goldens").join(name)
}

/// Holds `picture` against the golden `name`.
pub fn check(name: &str, picture: &RgbaImage, adapter: &wgpu::AdapterInfo) {
    let here = format!("{} {}", adapter.name, adapter.driver_info);
    let golden_path = path(&format!("{name}.png"));
    if std::env::var_os("UPDATE_GOLDENS").is_some() {
        std::fs::create_dir_all(golden_path.parent().unwrap()).unwrap();
        picture.save(&golden_path).unwrap();
        std::fs::write(path("adapter.txt"), format!("{here}\n")).unwrap();
        return;
    }
    if adapter.device_type != wgpu::DeviceType::Cpu {
        return super::skip("golden", &format!("goldens are for software Vulkan, this is {here}"));
    }
    let golden = image::open(&golden_path)
        .unwrap_or_else(|error| panic!("{}: {error}: UPDATE_GOLDENS=1 writes it", golden_path.display()))
        .to_rgba8();
    assert_eq!(golden.dimensions(), picture.dimensions(), "{name}: another size than the golden");
    let off = differing(&golden, picture);
    let recorded = std::fs::read_to_string(path("adapter.txt")).unwrap_or_default();
    let count = off.iter().filter(|&&off| off).count();
    let fine = if recorded.trim() == here {
        count == 0
    } else {
        count as f64 <= STRAYS * off.len() as f64 && largest_patch(&off, golden.width() as usize) < PATCH
    };
    if !fine {
        picture.save(path(&format!("{name}.new.png"))).unwrap();
        difference(&golden, &off).save(path(&format!("{name}.diff.png"))).unwrap();
        panic!("{name}: {count} pixels differ from the golden: see {name}.new.png and {name}.diff.png beside it");
    }
}

/// Which pixels differ by more than noise in any channel.
fn differing(a: &RgbaImage, b: &RgbaImage) -> Vec<bool> {
    a.pixels().zip(b.pixels()).map(|(p, q)| p.0.iter().zip(q.0).any(|(x, y)| x.abs_diff(y) > NOISE)).collect()
}

/// The golden, dimmed, with the differing pixels in red.
fn difference(golden: &RgbaImage, off: &[bool]) -> RgbaImage {
    let mut picture = golden.clone();
    for (pixel, &off) in picture.pixels_mut().zip(off) {
        *pixel = if off { Rgba([255, 0, 0, 255]) } else { Rgba([pixel[0] / 3, pixel[1] / 3, pixel[2] / 3, 255]) };
    }
    picture
}

/// Size of the largest set of differing pixels that touch, corners included.
fn largest_patch(off: &[bool], width: usize) -> usize {
    let mut left = off.to_vec();
    let mut largest = 0;
    for start in 0..left.len() {
        let mut stack = vec![start];
        let mut size = 0;
        while let Some(at) = stack.pop() {
            if !std::mem::take(&mut left[at]) {
                continue;
            }
            size += 1;
            let (x, y) = ((at % width) as i64, (at / width) as i64);
            for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
                let (nx, ny) = (x + dx, y + dy);
                let next = ny * width as i64 + nx;
                if (0..width as i64).contains(&nx) && (0..left.len() as i64).contains(&next) {
                    stack.push(next as usize);
                }
            }
        }
        largest = largest.max(size);
    }
    largest
}
