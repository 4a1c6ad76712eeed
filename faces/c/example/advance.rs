// SPDX-License-Identifier: Apache-2.0
// Runs a scenario and prints the speed at each millisecond, by plain declarations of the functions of sixstep.h.
//   rustc --edition 2021 -L FOLDER_OF_LIBSIXSTEP advance.rs && ./advance SCENARIO
use std::ffi::{CStr, CString};
use std::os::raw::{c_char, c_double, c_int, c_void};
use std::{env, ptr};

type Handle = *mut c_void;

#[link(name = "sixstep")]
extern "C" {
    fn sixstep_abi() -> u32;
    fn sixstep_open_file(path: *const c_char, options: *const c_void, session: *mut Handle) -> c_int;
    fn sixstep_free(session: Handle);
    fn sixstep_advance(session: Handle, to_s: c_double) -> c_int;
    fn sixstep_signal_index(name: *const c_char) -> c_int;
    fn sixstep_value(session: Handle, index: c_int) -> c_double;
    fn sixstep_finish(session: Handle) -> c_int;
    fn sixstep_outcome(session: Handle) -> *const c_char;
}

/// A session that is freed at the end of its scope. It may move to another thread, but two threads may not use it at once.
struct Drive(Handle);
unsafe impl Send for Drive {}
impl Drop for Drive {
    fn drop(&mut self) {
        unsafe { sixstep_free(self.0) }
    }
}

fn main() {
    let path = CString::new(env::args().nth(1).expect("give a scenario")).unwrap();
    let mut drive = Drive(ptr::null_mut());
    unsafe {
        assert_eq!(sixstep_abi(), 1);
        assert_eq!(sixstep_open_file(path.as_ptr(), ptr::null(), &mut drive.0), 0);
        let speed = sixstep_signal_index(b"speed_rad_s\0".as_ptr().cast());
        let mut ms = 1;
        while sixstep_advance(drive.0, 1e-3 * f64::from(ms)) == 0 {
            println!("{ms} ms  {:.4} rad/s", sixstep_value(drive.0, speed));
            ms += 1;
        }
        assert_eq!(sixstep_finish(drive.0), 0);
        print!("{}", CStr::from_ptr(sixstep_outcome(drive.0)).to_str().unwrap());
    }
}
