# Fits the example and has Octave read results.nc with the loader of docs/examples: the errors of all
# recordings are those of estimate.json, to the digit. Needs PROGRAM, SOURCE, WORK.
cmake_minimum_required(VERSION 3.25)

find_program(OCTAVE octave-cli)
if(NOT OCTAVE)
  message("skipped: there is no octave-cli")
  return()
endif()
file(REMOVE_RECURSE "${WORK}")
execute_process(COMMAND "${PROGRAM}" fit "${SOURCE}/docs/examples/locked-gear" --estimator midpoint_pooled --out "${WORK}"
                RESULT_VARIABLE code ERROR_VARIABLE text)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "the fit ended with ${code}: ${text}")
endif()
file(WRITE "${WORK}/check.m" "
pkg load netcdf
addpath('${SOURCE}/docs/examples/matlab')
results = read_results('results.nc');
estimate = jsondecode(fileread('estimate.json'));
stated = sort([cell2mat(struct2cell(estimate.rmse.train)); cell2mat(struct2cell(estimate.rmse.holdout))]);
read = sort(results.row_error.values(:));
assert(numel(read) == numel(stated) && all(abs(read - stated(:)) <= 1e-12 * abs(read)));
assert(isequal(results.parameter_value.dimensions, {'parameter', 'replicate', 'estimator', 'input'}));
printf('the results hold\\n');
")
execute_process(COMMAND "${OCTAVE}" --quiet check.m WORKING_DIRECTORY "${WORK}" OUTPUT_VARIABLE said ERROR_VARIABLE text)
if(NOT said MATCHES "the results hold")
  message(FATAL_ERROR "octave: ${said} ${text}")
endif()
