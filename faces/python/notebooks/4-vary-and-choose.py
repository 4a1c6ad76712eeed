# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Vary and choose
#
# Which settling time of the current loop holds a peak of 2.33 A, also for motors within tolerances?
# %%
import sixstep

s = sixstep.Scenario(
    motor="maxon-251601", duration_s="10ms", control={"mode": "current"}, reference={"value": 2, "unit": "A"},
    require=[{"metric": "max", "signal": "i_a", "max": 2.33, "label": "peak"}],
    spread=[{"key": "motor_override.resistance_ohm", "relative": 0.1}, {"key": "motor_override.inductance_mH", "relative": 0.2}])
table = sixstep.sweep(s, {"control.current.settle_s": [0.5e-3, 1e-3, 2e-3]}, drives=20, seed=1)
table
# %%
settle, peak = table["control.current.settle_s"], table["peak"]
for value in sorted(set(settle)):
    here = peak[settle == value]
    print(f"{1e3 * value:.1f} ms: peak {here.min():.3f} .. {here.max():.3f} A, {int((here <= 2.33).sum())} of {len(here)} hold")
