# Installs the build tree, moves the installed tree elsewhere, and builds and runs project/ and
# apps/examples against it. Proves that the package can be moved, points at neither the build tree nor
# the sources, shows nothing but Eigen in its headers and nothing but vantage in its symbols, and needs
# none of its own dependencies on a link line.

set(prefix "${work}/prefix")
set(hidden_dependencies OpenVDB OpenCV TBB embree assimp fmt PNG nlohmann_json)

function(run out)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${result}:\n${text}")
  endif()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

function(check_headers_show_only_eigen)
  file(GLOB_RECURSE headers "${prefix}/include/*")
  if(NOT headers)
    message(FATAL_ERROR "no headers were installed")
  endif()
  foreach(header IN LISTS headers)
    file(STRINGS "${header}" includes REGEX "^ *# *include")
    foreach(include IN LISTS includes)
      if(NOT include MATCHES "(\"vantage/[a-z0-9_/]+\\.hpp\"|<Eigen/[A-Za-z]+>|<[a-z_]+>)")
        message(FATAL_ERROR "${header} shows a dependency: ${include}")
      endif()
    endforeach()
  endforeach()
endfunction()

function(check_package_files_can_be_moved)
  file(GLOB_RECURSE files "${prefix}/*.cmake")
  foreach(file IN LISTS files)
    file(READ "${file}" text)
    foreach(tree IN ITEMS "${vantage_build}" "${vantage_source}")
      string(FIND "${text}" "${tree}" position)
      if(NOT position EQUAL -1)
        message(FATAL_ERROR "${file} points at ${tree}")
      endif()
    endforeach()
  endforeach()
endfunction()

function(check_link_line build_output)
  string(REGEX MATCH "(/lib|-l)(openvdb|opencv|embree|tbb|assimp|boost|fmt|png)[^ ]*" named
         "${build_output}")
  if(named)
    message(FATAL_ERROR "the consumer's link line names ${named}:\n${build_output}")
  endif()
endfunction()

# Each library of ours that `program` loads must come from the installed tree.
function(check_loads_from_prefix program)
  file(GET_RUNTIME_DEPENDENCIES EXECUTABLES "${program}"
       RESOLVED_DEPENDENCIES_VAR loaded UNRESOLVED_DEPENDENCIES_VAR not_found)
  list(FILTER loaded INCLUDE REGEX "/libvantage_")
  list(FILTER not_found INCLUDE REGEX "^libvantage_")
  if(not_found OR NOT loaded)
    message(FATAL_ERROR "${program} does not find '${not_found}', finds '${loaded}'")
  endif()
  foreach(library IN LISTS loaded)
    string(FIND "${library}" "${prefix}/" position)
    if(NOT position EQUAL 0)
      message(FATAL_ERROR "${program} loads ${library}, which is not the installed one")
    endif()
  endforeach()
endfunction()

# The libraries show namespace vantage, and no template of std, Eigen or OpenVDB that they use.
function(check_symbols)
  find_program(nm nm REQUIRED)
  file(GLOB libraries "${prefix}/lib*/libvantage_*.so" "${prefix}/lib/*/libvantage_*.so")
  if(NOT libraries)
    message(FATAL_ERROR "no libraries were installed")
  endif()
  foreach(library IN LISTS libraries)
    run(symbols "${nm}" -D --defined-only --demangle --format=posix "${library}")
    string(REGEX REPLACE "[;\\[]" "_" symbols "${symbols}")  # CMake's lists have no such elements
    string(STRIP "${symbols}" symbols)
    string(REGEX REPLACE "\n" ";" symbols "${symbols}")
    list(FILTER symbols EXCLUDE REGEX
         "^((typeinfo|typeinfo name|vtable|VTT) for |(non-virtual|virtual) thunk to )?vantage::")
    if(symbols)
      list(SUBLIST symbols 0 5 symbols)
      message(FATAL_ERROR "${library} shows symbols that are not vantage's:\n${symbols}")
    endif()
  endforeach()
endfunction()

file(REMOVE_RECURSE "${work}")
run(_ "${CMAKE_COMMAND}" --install "${vantage_build}" --prefix "${work}/first-prefix")
file(RENAME "${work}/first-prefix" "${prefix}")
check_headers_show_only_eigen()
check_package_files_can_be_moved()
check_symbols()

list(TRANSFORM hidden_dependencies REPLACE "(.+)" "-DCMAKE_DISABLE_FIND_PACKAGE_\\1=ON")
set(configure "${CMAKE_COMMAND}"
    -G "${generator}" "-DCMAKE_CXX_COMPILER=${compiler}" "-DCMAKE_PREFIX_PATH=${prefix}"
    -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF -DCMAKE_FIND_USE_SYSTEM_PACKAGE_REGISTRY=OFF
    ${hidden_dependencies})
run(_ ${configure} -S "${CMAKE_CURRENT_LIST_DIR}/project" -B "${work}/build"
    "-DVANTAGE_EXPECTED_VERSION=${version}")
run(build_output "${CMAKE_COMMAND}" --build "${work}/build" --verbose)
check_link_line("${build_output}")
check_loads_from_prefix("${work}/build/consumer")
file(GLOB command "${prefix}/*/vantage/vantage-command")  # what bin/vantage becomes
check_loads_from_prefix("${command}")
run(printed "${work}/build/consumer")
message("${printed}")
run(_ "${prefix}/bin/vantage" plan --help)
run(printed "${prefix}/bin/vantage" --version)
message("${printed}")

file(GLOB examples RELATIVE "${vantage_source}/apps/examples" "${vantage_source}/apps/examples/*.cpp")
run(_ ${configure} -S "${vantage_source}/apps/examples" -B "${work}/examples"
    "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Wshadow -Werror")
run(build_output "${CMAKE_COMMAND}" --build "${work}/examples" --verbose)
check_link_line("${build_output}")
foreach(example IN LISTS examples)
  string(REPLACE ".cpp" "" example "${example}")
  run(printed "${work}/examples/${example}")
  if(printed STREQUAL "")
    message(FATAL_ERROR "the example ${example} prints nothing")
  endif()
  message("${example}: ${printed}")
endforeach()
