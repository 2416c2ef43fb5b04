# Installs the build into a prefix of its own; then a project that knows nothing but that prefix finds COMPONENT there,
# builds SOURCE with it and runs the program with ARGUMENTS, and exact_arithmetic.cpp with flags of its own. Packages in WITHOUT count as missing on the machine.
# Usage: cmake -D BUILD=... -D CONFIGURATION=... -D GENERATOR=... -D COMPILER=... -D FLAGS=... -D FOLDER=...
#        -D COMPONENT=... -D SOURCE=... [-D WITHOUT=...] [-D ARGUMENTS=...] -P find_package.cmake

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# What an earlier run left must not help.
file(REMOVE_RECURSE "${FOLDER}")
run("${CMAKE_COMMAND}" --install "${BUILD}" --config "${CONFIGURATION}" --prefix "${FOLDER}/prefix")
foreach(package IN LISTS WITHOUT)
  list(APPEND missing "-DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON")
endforeach()
run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}" -B "${FOLDER}/build" -G "${GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${FOLDER}/prefix" "-DCMAKE_BUILD_TYPE=${CONFIGURATION}" "-DCOMPONENT=${COMPONENT}"
    "-DSOURCE=${SOURCE}" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}"
    "-DCMAKE_RUNTIME_OUTPUT_DIRECTORY=${FOLDER}/program" ${missing})
run("${CMAKE_COMMAND}" --build "${FOLDER}/build" --config "${CONFIGURATION}")
find_program(consumer NAMES consumer PATHS "${FOLDER}/program" "${FOLDER}/program/${CONFIGURATION}" NO_DEFAULT_PATH
             REQUIRED)
run("${consumer}" ${ARGUMENTS})
find_program(exact_arithmetic NAMES exact_arithmetic PATHS "${FOLDER}/program" "${FOLDER}/program/${CONFIGURATION}"
             NO_DEFAULT_PATH REQUIRED)
run("${exact_arithmetic}")
