# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # A speed loop with Hall probes
#
# What does the sensor cost at low speed? The same loop, once with an ideal speed and once with the speed from Hall edges.
# %%
import sixstep

def scenario(rotor):
    return sixstep.Scenario(motor="maxon-251601", duration_s="0.4s",
                            control={"mode": "speed", "current": {"settle_s": 1e-3}, "speed": {"settle_s": 25e-3, "torque_limit_Nm": 0.1}},
                            sensors={"rotor": rotor}, reference={"value": 40, "unit": "rad/s"},
                            load={"torque_Nm": 0.02}, record={"grid_s": 1e-4})

ideal, hall = (sixstep.run(scenario(rotor), books=False) for rotor in ("ideal", "hall"))
for name, r in (("ideal", ideal), ("hall", hall)):
    late = r.time > 0.3
    print(f"{name:6} overshoot {r.speed.max() - 40:6.2f} rad/s, speed ripple at the end {r.speed[late].max() - r.speed[late].min():.2f} rad/s")
# %%
hall.plot("speed", "i_a")
