function results = read_results(file)
% READ_RESULTS  A study's results.nc as a struct, in MATLAB or in Octave (pkg load netcdf).
%   r = read_results("out/paper/results.nc");
%   r.<variable>.values      numbers, NaN where a case has none
%   r.<variable>.dimensions  cell of names, in the order of size(values)
%   r.<variable>.unit        as the file states it, '' where it has none
%   r.<variable>.long_name   what it is
% Octave's package reads no variables of text: their names stand in r.not_read, and the same rows with
% their names in the study's tables/*.csv. MATLAB reads them since R2017b.
if exist('OCTAVE_VERSION', 'builtin')
  import_netcdf  % names as in MATLAB
end
id = netcdf.open(file, 'NOWRITE');
closer = onCleanup(@() netcdf.close(id));
[~, variables] = netcdf.inq(id);
results = struct('not_read', {{}});
for k = 0:variables - 1
  [name, ~, dimensions] = netcdf.inqVar(id, k);
  try
    one.values = netcdf.getVar(id, k);
  catch
    results.not_read{end + 1} = name;
    continue
  end
  one.dimensions = arrayfun(@(d) netcdf.inqDim(id, d), dimensions, 'UniformOutput', false);
  one.unit = attribute(id, k, 'units');
  one.long_name = attribute(id, k, 'long_name');
  results.(name) = one;
end
end

function text = attribute(id, variable, name)
if exist('OCTAVE_VERSION', 'builtin')
  import_netcdf
end
try
  text = netcdf.getAtt(id, variable, name);
catch
  text = '';
end
end
