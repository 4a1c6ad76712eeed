# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # A first drive
#
# How fast does a current loop settle, and what does its current look like? A scenario says motor, controller and
# requirement; the run says whether it holds.
# %%
import sixstep

s = sixstep.Scenario(
    motor="maxon-251601", duration_s="10ms",
    control={"mode": "current", "current": {"settle_s": 1e-3}},
    reference={"value": 2, "unit": "A"},
    load={"locked": True},
    record={"grid_s": 1e-6},
    require=[{"metric": "settling_time_s", "signal": "current", "band": 0.1, "max": 3e-3, "label": "settles"}])
r = sixstep.run(s)
r
# %% [markdown]
# Recorded columns are numpy arrays with units. With the rotor held, the voltage that the current needs is 2 R i.
# %%
late = r.time > 8e-3
print(f"mean current of phase a: {r.i_a[late].mean():.3f} A, ripple {r.i_a[late].max() - r.i_a[late].min():.3f} A")
print(f"energy that the source gave: {r.energy['supplied_J']:.4f} J, of which copper took {r.energy['copper_J']:.4f} J")
# %% [markdown]
# A shorter PWM period makes the ripple smaller in proportion.
# %%
for period in ("30us", "15us"):
    x = sixstep.run(s.copy(pwm__period_s=period), books=False)
    late = x.time > 8e-3
    print(period, f"{x.i_a[late].max() - x.i_a[late].min():.3f} A")
