% SPDX-License-Identifier: Apache-2.0
% Runs a scenario and prints speed and current at each millisecond: octave-cli advance.m SCENARIO
% Compile sixstep_advance.cc before; its first lines contain the command.
scenario = argv(){1};
t = 1e-3 * (1:20)';
[values, outcome] = sixstep_advance(scenario, t, {"t_s", "speed_rad_s", "i_m_A"});
for k = 1:rows(values)
  printf("%.3f ms  %.4f rad/s  %.4f A\n", 1e3 * values(k, 1), values(k, 2), values(k, 3));
end
printf("%s", outcome);
