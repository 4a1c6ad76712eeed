# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Your motor from its data sheet
#
# Does the sheet agree with itself, and which gains follow from it? Write the values as the sheet prints them, with their unit
# and the points between which they are measured.
# %%
import pathlib

import sixstep

pathlib.Path("mine.toml").write_text('''
name = "my motor"
pole_pairs = 4
back_emf = "sine"
nominal_voltage_V = 24
resistance_ohm = { value = 0.60, frame = "terminal" }
inductance_mH = { value = 0.450, frame = "terminal" }
torque_constant_mNm_A = 45.0
inertia_gcm2 = 120
no_load_speed_rpm = 5060
no_load_current_mA = 200
nominal_current_A = { value = 4.00, frame = "terminal" }
''')
print(sixstep.check("mine.toml"))
# %% [markdown]
# Gains for the current loop, simulated with all switching:
# %%
design = sixstep.design("mine.toml", quick=True)
print("usable:", design.ok, "-", design.verdict)
gains = design.loops[0].gains
print("d1 =", round(gains.d1, 5), "V/A, d0 =", round(gains.d0, 5), "V/A")
# %% [markdown]
# And the torque-speed curve:
# %%
curve = sixstep.curve("mine.toml", points=11)
print(curve.text[:900])
