// SPDX-License-Identifier: BSD-3-Clause
// The example of examples/c by the C interface from Rust: the functions that it needs declared by hand, what they hand out owned by
// types that free it.
use std::ffi::{c_char, c_int, CStr, CString};
use std::ptr;

#[repr(C)]
struct Scene([u8; 0]);
#[repr(C)]
struct Answer([u8; 0]);
#[repr(C)]
struct Propagator([u8; 0]);

extern "C" {
    fn gyrostat_message() -> *const c_char;
    fn gyrostat_scene_new() -> *mut Scene;
    fn gyrostat_scene_free(scene: *mut Scene);
    fn gyrostat_add(scene: *mut Scene, what: *const c_char, kind: *const c_char) -> c_int;
    fn gyrostat_set(scene: *mut Scene, key: *const c_char, values: *const f64, count: usize) -> c_int;
    fn gyrostat_solve(scene: *const Scene, answer: *mut *mut Answer) -> c_int;
    fn gyrostat_answer_free(answer: *mut Answer);
    fn gyrostat_answer_model(answer: *const Answer) -> *const c_char;
    fn gyrostat_answer_met(answer: *const Answer) -> c_int;
    fn gyrostat_answer_column(answer: *const Answer, name: *const c_char, values: *mut *const f64, rows: *mut usize, width: *mut usize) -> c_int;
    fn gyrostat_answer_error(answer: *const Answer, name: *const c_char, error: *mut f64, size: *mut f64) -> c_int;
    fn gyrostat_propagator_new(scene: *const Scene, propagator: *mut *mut Propagator) -> c_int;
    fn gyrostat_propagator_free(propagator: *mut Propagator);
    fn gyrostat_propagate(propagator: *const Propagator, dt: f64, attitude: *mut f64, angular_velocity: *mut f64, rotor_rate: *mut f64, error: *mut f64) -> c_int;
}

/// What a function of the library came to.
fn checked(code: c_int) -> Result<(), String> {
    match code {
        0 => Ok(()),
        _ => Err(unsafe { CStr::from_ptr(gyrostat_message()) }.to_string_lossy().into_owned()),
    }
}

fn c(text: &str) -> CString {
    CString::new(text).expect("a name without zeros")
}

struct OwnScene(*mut Scene);

impl OwnScene {
    fn set(&mut self, key: &str, values: &[f64]) -> Result<(), String> {
        checked(unsafe { gyrostat_set(self.0, c(key).as_ptr(), values.as_ptr(), values.len()) })
    }
    fn add(&mut self, what: &str, kind: &str) -> Result<(), String> {
        checked(unsafe { gyrostat_add(self.0, c(what).as_ptr(), c(kind).as_ptr()) })
    }
    fn solve(&self) -> Result<OwnAnswer, String> {
        let mut made = ptr::null_mut();
        checked(unsafe { gyrostat_solve(self.0, &mut made) }).map(|()| OwnAnswer(made))
    }
    fn propagator(&self) -> Result<OwnPropagator, String> {
        let mut made = ptr::null_mut();
        checked(unsafe { gyrostat_propagator_new(self.0, &mut made) }).map(|()| OwnPropagator(made))
    }
}
impl Drop for OwnScene {
    fn drop(&mut self) {
        unsafe { gyrostat_scene_free(self.0) }
    }
}

struct OwnAnswer(*mut Answer);

impl OwnAnswer {
    fn model(&self) -> String {
        unsafe { CStr::from_ptr(gyrostat_answer_model(self.0)) }.to_string_lossy().into_owned()
    }
    fn met(&self) -> bool {
        unsafe { gyrostat_answer_met(self.0) == 1 }
    }
    fn column(&self, name: &str) -> Result<&[f64], String> {
        let (mut values, mut rows, mut width) = (ptr::null(), 0, 0);
        checked(unsafe { gyrostat_answer_column(self.0, c(name).as_ptr(), &mut values, &mut rows, &mut width) })?;
        Ok(unsafe { std::slice::from_raw_parts(values, rows * width) })
    }
    fn error(&self, name: &str) -> Result<f64, String> {
        let (mut error, mut size) = (0.0, 0.0);
        checked(unsafe { gyrostat_answer_error(self.0, c(name).as_ptr(), &mut error, &mut size) })?;
        Ok(error * size)
    }
}
impl Drop for OwnAnswer {
    fn drop(&mut self) {
        unsafe { gyrostat_answer_free(self.0) }
    }
}

struct OwnPropagator(*mut Propagator);

impl Drop for OwnPropagator {
    fn drop(&mut self) {
        unsafe { gyrostat_propagator_free(self.0) }
    }
}

/// As C writes a number with %.{digits}e.
fn scientific(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$e}");
    let (mantissa, exponent) = text.split_once('e').expect("an exponent");
    let exponent: i32 = exponent.parse().expect("a whole exponent");
    format!("{mantissa}e{}{:02}", if exponent < 0 { '-' } else { '+' }, exponent.abs())
}

fn main() -> Result<(), String> {
    let times = [60.0, 600.0, 3600.0]; // s
    let mut scene = OwnScene(unsafe { gyrostat_scene_new() });
    scene.set("body.inertia", &[86.0, 118.0, 141.0])?; // kg m^2
    scene.set("initial.angular_velocity", &[0.0, 0.01, 0.1])?; // rad/s: about the axis of greatest inertia, the wheel at rest
    scene.add("wheel", "motor")?;
    scene.set("wheel.axis", &[1.0, 0.05, 0.04])?; // of any length
    scene.set("wheel.axial_inertia", &[0.28])?;
    scene.set("wheel.slope", &[0.13])?;
    scene.set("wheel.no_load_rate", &[60.0])?;
    scene.set("solve.times", &times)?;
    scene.set("solve.tolerance", &[1e-6])?;

    let answer = scene.solve()?;
    let met = if answer.met() { "met" } else { "not met" };
    let error = scientific(answer.error("rotor_rate")?, 1);
    println!("model {}, stated error of the wheel's rate {error} rad/s, tolerance {met}", answer.model());
    for (t, rate) in times.iter().zip(answer.column("rotor_rate")?) {
        println!("t = {t:.0} s: wheel at {rate:.6} rad/s");
    }

    let propagator = scene.propagator()?;
    let (mut attitude, mut rate, mut wheel, mut error) = ([0.0, 0.0, 0.0, 1.0], [0.0, 0.01, 0.1], [0.0], [0.0; 3]);
    for _ in 0..10 {
        checked(unsafe {
            gyrostat_propagate(propagator.0, 0.1, attitude.as_mut_ptr(), rate.as_mut_ptr(), wheel.as_mut_ptr(), error.as_mut_ptr())
        })?;
    }
    println!("after ten steps: wheel at {:.9} rad/s, the last step within {} rad/s", wheel[0], scientific(error[2], 0));
    Ok(())
}
