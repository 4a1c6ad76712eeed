# SPDX-License-Identifier: Apache-2.0
# Runs a scenario and prints the speed at each millisecond: julia advance.jl SCENARIO
const sixstep = "libsixstep.so.1"

@assert ccall((:sixstep_abi, sixstep), UInt32, ()) == 1
session = Ref{Ptr{Cvoid}}(C_NULL)
status = ccall((:sixstep_open_file, sixstep), Cint, (Cstring, Ptr{Cvoid}, Ref{Ptr{Cvoid}}), ARGS[1], C_NULL, session)
drive = session[]

try
    status == 0 || error("the scenario was refused")
    speed = ccall((:sixstep_signal_index, sixstep), Cint, (Cstring,), "speed_rad_s")
    ms = 1
    while ccall((:sixstep_advance, sixstep), Cint, (Ptr{Cvoid}, Cdouble), drive, 1e-3 * ms) == 0
        println(ms, " ms  ", ccall((:sixstep_value, sixstep), Cdouble, (Ptr{Cvoid}, Cint), drive, speed), " rad/s")
        global ms += 1
    end
    @assert ccall((:sixstep_finish, sixstep), Cint, (Ptr{Cvoid},), drive) == 0
    print(unsafe_string(ccall((:sixstep_outcome, sixstep), Cstring, (Ptr{Cvoid},), drive)))
finally
    ccall((:sixstep_free, sixstep), Cvoid, (Ptr{Cvoid},), drive)
end
