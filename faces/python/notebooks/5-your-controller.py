# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # A controller of your own
#
# A speed controller in Python takes the place of the drive. The environment tries many of them at once.
# %%
import numpy as np

import sixstep

speed = sixstep.Scenario(motor="maxon-251601", duration_s="0.3s", control={"mode": "speed"},
                         reference={"value": 200, "unit": "rad/s"}, load={"torque_Nm": 0.02})

class PI:
    def __init__(self, gain, integral):
        self.gain, self.integral = gain, integral

    def start(self, given):
        self.sum, self.period_s = 0.0, given["period_s"]

    def step(self, m, setpoint):
        error = setpoint - m.speed_rad_s
        duty = self.gain * error + self.sum
        if abs(duty) < 1:
            self.sum += self.integral * self.period_s * error
        return max(-1.0, min(1.0, duty))

r = sixstep.run(speed, PI(0.004, 0.1))
print(f"speed at the end {r.speed[-1]:.2f} rad/s, largest {r.speed.max():.2f} rad/s")
# %% [markdown]
# A policy with two parameters, learned by the cross-entropy method: draw 64, keep the best 8, draw around them. The reward is
# minus the distance from the setpoint in each step of ten control periods.
# %%
env = sixstep.Env(speed, drives=64, hold=10)
rng = np.random.default_rng(1)

def tried(gains):
    seen, _ = env.reset(seed=1)
    total, sums = np.zeros(len(gains)), np.zeros(len(gains))
    for _ in range(900):
        error = seen[:, -1] - env.value(seen, "speed_rad_s")
        duty = gains[:, 0] * error + sums
        sums += np.where(np.abs(duty) < 1, gains[:, 1] * 300e-6 * error, 0)
        seen, reward, _, _, _ = env.step(np.clip(duty, -1, 1)[:, None])
        total += reward
    return total / 900

mean, spread = np.array([0.004, 0.1]), np.array([0.003, 0.08])
first = tried(np.tile(mean, (64, 1)))[0]
for generation in range(6):
    gains = np.abs(mean + spread * rng.standard_normal((64, 2)))
    total = tried(gains)
    best = gains[np.argsort(total)[-8:]]
    mean, spread = best.mean(axis=0), best.std(axis=0) + 1e-5
    print(f"generation {generation}: best mean distance {-total.max():.3f} rad/s, gains {mean.round(5)}")
learned = tried(np.tile(mean, (64, 1)))[0]
print(f"the PI by hand: {-first:.3f} rad/s, learned: {-learned:.3f} rad/s")
