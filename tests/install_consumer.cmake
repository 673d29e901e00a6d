# Installs the build into a folder of its own, builds the consumer of docs/examples against it, and has
# it refuse a data set that is not there: the package finds all that it stands on.
# Needs BUILD, SOURCE, WORK.
cmake_minimum_required(VERSION 3.25)

include("${CMAKE_CURRENT_LIST_DIR}/call.cmake")

file(REMOVE_RECURSE "${WORK}")
call("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
call("${CMAKE_COMMAND}" -S "${SOURCE}/docs/examples/consumer" -B "${WORK}/consumer"
     "-DCMAKE_PREFIX_PATH=${WORK}/prefix")
call("${CMAKE_COMMAND}" --build "${WORK}/consumer")
execute_process(COMMAND "${WORK}/consumer/consumer" "${WORK}/nowhere" trajectory_ceres
                RESULT_VARIABLE code ERROR_VARIABLE text)
if(NOT code EQUAL 66 OR NOT text MATCHES "nowhere")
  message(FATAL_ERROR "the consumer ended with ${code}: ${text}")
endif()
call("${WORK}/prefix/bin/flexspline" init bench "${WORK}/bench")
call("${WORK}/prefix/bin/flexspline" conceal "${WORK}/bench.toml" --out "${WORK}/concealed")
execute_process(COMMAND "${WORK}/consumer/consumer" "${WORK}/concealed/dataset" midpoint_pooled
                RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
if(NOT code EQUAL 0 OR NOT text MATCHES "midpoint_pooled: [1-9]")
  message(FATAL_ERROR "the consumer ended with ${code}: ${text}")
endif()
