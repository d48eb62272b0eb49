// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of a program that shows rain on a windshield as it falls: rain FRAMES
//   bindgen PREFIX/include/droplet/c/droplet.h -o droplet.rs
//   rustc rain.rs -L PREFIX/lib -l droplet_c
#![allow(non_camel_case_types, non_upper_case_globals, dead_code)]
use std::ffi::{CStr, CString};
use std::ptr;

mod droplet;

/// Rain that ends when it leaves its scope.
struct Rain(*mut droplet::DropletWindshield);

impl Drop for Rain {
    fn drop(&mut self) {
        unsafe { droplet::droplet_windshield_delete(self.0) }
    }
}

fn checked(code: droplet::DropletCode) -> Result<(), String> {
    if code == 0 {
        return Ok(());
    }
    Err(unsafe { CStr::from_ptr(droplet::droplet_message()) }.to_string_lossy().into_owned())
}

fn run(frames: i32) -> Result<(), String> {
    const WIDTH: i32 = 1024;
    let mut rain = Rain(ptr::null_mut());
    let preset = CString::new("figure-3.12").unwrap();
    let wipers = CString::new("wiper-period").unwrap();
    let mut height = 0;
    unsafe {
        checked(droplet::droplet_windshield_new(preset.as_ptr(), &mut rain.0))?;
        checked(droplet::droplet_windshield_set(rain.0, wipers.as_ptr(), 1.2))?;
        checked(droplet::droplet_windshield_map_height(rain.0, WIDTH, &mut height))?;
    }
    // RGBA, half floats: normal x and y times wetness, thickness in mm, wetness.
    let mut pixels = vec![0u16; 4 * (WIDTH * height) as usize];
    for frame in 0..frames {
        // A driver's inputs go here: droplet_windshield_set(rain.0, speed.as_ptr(), 30.0).
        let mut tiles = droplet::DropletTiles { list: ptr::null(), count: 0 };
        let running = unsafe {
            checked(droplet::droplet_windshield_advance(rain.0, 1.0 / 60.0))?;
            checked(droplet::droplet_windshield_draw(rain.0, WIDTH, pixels.as_mut_ptr(), &mut tiles))?;
            droplet::droplet_windshield_running(rain.0, ptr::null_mut(), 0)
        };
        // For each tile: upload its pixels.
        println!("{frame}: {running} run, {} tiles changed", tiles.count);
    }
    Ok(())
}

fn main() {
    let frames = std::env::args().nth(1).and_then(|word| word.parse().ok()).unwrap_or(60);
    if let Err(message) = run(frames) {
        eprintln!("{message}");
        std::process::exit(2);
    }
}
