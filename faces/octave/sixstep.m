% SPDX-License-Identifier: Apache-2.0
% SIXSTEP  Runs the program sixstep from GNU Octave (7 or newer) and MATLAB (R2016b or newer), without a toolbox.
%
%   r = sixstep.run("drive.toml", "supply.voltage_V", 22);        one run: summary, signals, units
%   v = sixstep.vary("drive.toml", "pwm.period_s", "20us:60us:5"); a grid of runs, one row each
%   d = sixstep.design("maxon-251601", "mode", "speed");           gains and their verification
%   sixstep.plot(r, "speed_rad_s", "i_a_A")                        signals over the time
%
% The program is found in this order: sixstep.program("/opt/sixstep/bin/sixstep"), the environment variable
% SIXSTEP_PROGRAM, bin/ of the installation that this file belongs to, and the search path.
% A problem is an error with the identifier "sixstep:refused" and the program's own words.
classdef sixstep
  methods (Static)

    function r = run(scenario, varargin)
      % R = SIXSTEP.RUN(SCENARIO, KEY, VALUE, ...) runs a scenario file. The given keys replace keys of the file. Values are numbers
      % or texts ("20us").
      %   R.summary  verdicts and figures as `sixstep run --json` writes them; R.passed, R.fault, R.digest from it
      %   R.signals  a column for each recorded signal: R.signals.t_s, R.signals.i_a_A
      %   R.units    unit of each signal: R.units.i_a_A
      folder = sixstep.scratch();
      cleanup = onCleanup(@() sixstep.remove(folder));
      sixstep.called([{'run', scenario, '--quiet', '--json', fullfile(folder, 'run.json'), '--mat', fullfile(folder, 'run.mat')}, ...
                      sixstep.settings(varargin)]);
      r.summary = sixstep.decoded(fullfile(folder, 'run.json'));
      r.passed = r.summary.passed;
      r.fault = r.summary.fault;
      r.digest = r.summary.digest;
      loaded = load(fullfile(folder, 'run.mat'));
      r.units = loaded.units;
      names = fieldnames(loaded);
      for k = 1:numel(names)
        if isnumeric(loaded.(names{k}))
          r.signals.(names{k}) = loaded.(names{k});
        end
      end
    end

    function v = vary(scenario, varargin)
      % V = SIXSTEP.VARY(SCENARIO, KEY, VALUES, ...) runs the scenario at each point of a grid. VALUES is a vector of numbers, or
      % a text: "20us:60us:5" (from, to, points), "20us,40us".
      %   V.columns  names of the columns, a cell; V.rows: the cells of each run; V.values: numbers of the cells, NaN for texts
      %   V.summary  the whole result as `sixstep run --json` writes it
      if isempty(varargin) || mod(numel(varargin), 2) ~= 0
        error('sixstep:refused', 'sixstep.vary: needs pairs of a key and its values; give sixstep.vary(file, "pwm.period_s", "20us:60us:5")');
      end
      folder = sixstep.scratch();
      cleanup = onCleanup(@() sixstep.remove(folder));
      words = {'run', scenario, '--quiet', '--json', fullfile(folder, 'runs.json')};
      for k = 1:2:numel(varargin)
        words = [words, {'--vary', [char(varargin{k}), '=', sixstep.listed(varargin{k + 1})]}];
      end
      sixstep.called(words);
      v.summary = sixstep.decoded(fullfile(folder, 'runs.json'));
      v.columns = v.summary.columns(:)';
      v.rows = sixstep.cells(v.summary.rows, numel(v.columns));
      v.values = NaN(size(v.rows));
      for k = 1:numel(v.rows)
        if (isnumeric(v.rows{k}) || islogical(v.rows{k})) && isscalar(v.rows{k})
          v.values(k) = double(v.rows{k});
        end
      end
    end

    function d = design(motor, varargin)
      % D = SIXSTEP.DESIGN(MOTOR, OPTION, VALUE, ...) designs a motor's loops, as `sixstep design MOTOR --OPTION VALUE --json`
      % does: "mode", "settle", "voltage" and the others of `sixstep design --help`.
      folder = sixstep.scratch();
      cleanup = onCleanup(@() sixstep.remove(folder));
      words = {'design', motor, '--json', fullfile(folder, 'design.json')};
      if mod(numel(varargin), 2) ~= 0
        error('sixstep:refused', 'sixstep.design: needs pairs of an option and its value; the last option has none');
      end
      for k = 1:2:numel(varargin)
        words = [words, {['--', char(varargin{k})], sixstep.written(varargin{k + 1})}];
      end
      sixstep.called(words);
      d = sixstep.decoded(fullfile(folder, 'design.json'));
    end

    function plot(r, varargin)
      % SIXSTEP.PLOT(R, SIGNAL, ...) draws signals of a run over the time, one below the other.
      for k = 1:numel(varargin)
        name = char(varargin{k});
        if ~isfield(r.signals, name)
          error('sixstep:refused', 'sixstep.plot: %s is no signal of this run; known are %s', name, strjoin(fieldnames(r.signals)', ', '));
        end
        subplot(numel(varargin), 1, k);
        plot(1e3 * r.signals.t_s, r.signals.(name));
        ylabel(sprintf('%s [%s]', strrep(name, '_', '\_'), r.units.(name)));
        grid('on');
      end
      xlabel('t [ms]');
    end

    function path = program(chosen)
      % SIXSTEP.PROGRAM(PATH) sets the program; PATH = SIXSTEP.PROGRAM() returns the program that is called.
      persistent own
      if nargin > 0
        own = char(chosen);
      end
      installed = fullfile(fileparts(mfilename('fullpath')), '..', '..', '..', 'bin', 'sixstep');
      if ~isempty(own)
        path = own;
      elseif ~isempty(getenv('SIXSTEP_PROGRAM'))
        path = getenv('SIXSTEP_PROGRAM');
      elseif exist(installed, 'file') == 2
        path = installed;
      else
        path = 'sixstep';
      end
    end

  end

  methods (Static, Hidden)

    function called(words)
      % Exit codes 0, 1 and 3 have results: the requirements hold, a requirement fails, a fault stopped the run.
      command = sixstep.quoted(sixstep.program());
      for k = 1:numel(words)
        command = [command, ' ', sixstep.quoted(words{k})];
      end
      [code, told] = system([command, ' 2>&1']);
      if code == 127
        error('sixstep:refused', 'sixstep.program: %s was not found; choose it: sixstep.program("/path/to/sixstep")', sixstep.program());
      elseif ~any(code == [0, 1, 3])
        error('sixstep:refused', '%s', strtrim(told));
      end
    end

    function words = settings(pairs)
      if mod(numel(pairs), 2) ~= 0
        error('sixstep:refused', 'sixstep.run: needs pairs of a key and its value; the last key has none');
      end
      words = {};
      for k = 1:2:numel(pairs)
        words = [words, {'--set', [char(pairs{k}), '=', sixstep.written(pairs{k + 1})]}];
      end
    end

    function text = written(value)
      % A number with all its digits, or a list of TOML.
      if islogical(value) && isscalar(value)
        words = {'false', 'true'};
        text = words{1 + value};
      elseif isnumeric(value) && isscalar(value)
        text = sprintf('%.17g', value);
      elseif isnumeric(value)
        text = ['[', strjoin(arrayfun(@(x) sprintf('%.17g', x), value(:)', 'UniformOutput', false), ','), ']'];
      else
        text = char(value);
      end
    end

    function text = listed(values)
      if isnumeric(values)
        text = strjoin(arrayfun(@(x) sprintf('%.17g', x), values(:)', 'UniformOutput', false), ',');
      else
        text = char(values);
      end
    end

    function text = quoted(word)
      text = ['''', strrep(char(word), '''', '''\'''''), ''''];
    end

    function value = decoded(file)
      value = jsondecode(fileread(file));
    end

    function out = cells(rows, count)
      % jsondecode makes cells of rows with texts.
      out = cell(numel(rows), count);
      for n = 1:numel(rows)
        out(n, :) = rows{n}(:)';
      end
    end

    function folder = scratch()
      folder = tempname();
      mkdir(folder);
    end

    function remove(folder)
      files = dir(folder);
      for k = 1:numel(files)
        if ~files(k).isdir
          delete(fullfile(folder, files(k).name));
        end
      end
      rmdir(folder);
    end
  end
end
