# How every target of vantage is compiled, and `vantage_library`, which declares a module.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
# -O2 leaves GCC 12's vectoriser timid: the field-of-view kernel is several times slower with it.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
if(VANTAGE_SANITIZE)
  set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g1")  # reports show lines and nothing else
else()
  set(CMAKE_CXX_FLAGS_DEBUG "-Og -g")
endif()

# What was compiled before, in whichever checkout, is taken from the cache. Precompiled headers hold
# no __TIME__ of ours; ccache wants to be told so.
find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env "CCACHE_BASEDIR=${CMAKE_SOURCE_DIR}" CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE}")
endif()
find_program(MOLD mold)
if(MOLD)
  add_link_options(-fuse-ld=mold)
endif()
# A library's change does not change what a program that uses it is linked from.
set(CMAKE_LINK_DEPENDS_NO_SHARED ON)

add_library(vantage_options INTERFACE)
target_compile_options(vantage_options INTERFACE
  -ffp-contract=off  # a fused multiply-add here and not there would make results depend on the kernel
  -fno-math-errno    # nobody reads it, and for its sake square roots would be taken one by one
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${VANTAGE_WERROR}>:-Werror>)
if(VANTAGE_SANITIZE)
  target_compile_definitions(vantage_options INTERFACE VANTAGE_SANITIZED=1)
  # Half of all compiling would be for checks of each address that the hardware and the address
  # sanitizer make, too: that it is not null, aligned, within its object and its space.
  target_compile_options(vantage_options INTERFACE
    -fsanitize=${VANTAGE_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize=null,alignment,pointer-overflow
    $<$<CXX_COMPILER_ID:GNU>:-fno-sanitize=object-size>)  # Clang has none without optimisation
  target_link_options(vantage_options INTERFACE -fsanitize=${VANTAGE_SANITIZE})
endif()

# libFuzzer finds its way by what of the libraries an input reached: tests/fuzz/CMakeLists.txt.
option(VANTAGE_LIBFUZZER "Build the fuzz targets with clang's libFuzzer" OFF)
if(VANTAGE_LIBFUZZER)
  target_compile_options(vantage_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Clang's precompiled headers are otherwise new to ccache each time.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  target_compile_options(vantage_options INTERFACE "SHELL:-Xclang -fno-pch-timestamp"
    -Wno-bitwise-instead-of-logical -Wno-bitwise-conditional-parentheses)  # without branches: lanes
endif()

# What turns a slip in memory into an end instead of an exploit.
if(NOT VANTAGE_SANITIZE)
  target_compile_options(vantage_options INTERFACE
    -fstack-protector-strong -fstack-clash-protection
    $<$<CONFIG:Release>:-U_FORTIFY_SOURCE> $<$<CONFIG:Release>:-D_FORTIFY_SOURCE=3>)
endif()
add_link_options(LINKER:-z,relro,-z,now,-z,noexecstack)

# For what parses, prints and checks: it takes no time that better code would save.
set(VANTAGE_UNHURRIED $<$<CONFIG:Release>:-O1>)

# vantage_compile_together(TARGET [BATCH number] [HEADERS header... | LIKE other_target])
#
# Compiles several of a target's sources as one, with common headers precompiled: a median source
# has fifty lines of its own and a hundred thousand of headers. LIKE takes the other target's
# precompiled headers, which only works if both are compiled with the same flags, and this one with
# all of the other's definitions. Without VANTAGE_UNITY every source stands alone and includes what
# it needs: preset no-unity.
function(vantage_compile_together target)
  cmake_parse_arguments(arg "" "BATCH;LIKE" "HEADERS" ${ARGN})
  if(NOT VANTAGE_UNITY)
    return()
  endif()
  if(NOT arg_BATCH)
    set(arg_BATCH 50)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${arg_BATCH})
  # Sources that are included by another file are no headers. And where much is inlined, GCC 12 sees
  # things in std::string's operator+ that are not there (its bugs 105329 and 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE
      -Wno-subobject-linkage -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow)
  endif()
  if(arg_LIKE)
    target_precompile_headers(${target} REUSE_FROM ${arg_LIKE})
  elseif(arg_HEADERS)
    target_precompile_headers(${target} PRIVATE ${arg_HEADERS})
  endif()
endfunction()

# What most sources include.
set(VANTAGE_COMMON_HEADERS
    <Eigen/Core> <Eigen/Geometry> <fmt/format.h> <fmt/ranges.h> <tbb/parallel_for.h>
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory>
    <numeric> <optional> <set> <span> <string> <string_view> <utility> <vector>)

# The precompiled headers of all that is linked into shared libraries.
function(vantage_precompile_common_headers)
  set(source "${PROJECT_BINARY_DIR}/precompiled.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "// Nothing but the headers that are precompiled.\n")
  add_library(vantage_precompiled OBJECT "${source}")
  set_target_properties(vantage_precompiled PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(vantage_precompiled
                        PRIVATE Eigen3::Eigen TBB::tbb fmt::fmt vantage_options)
  target_precompile_headers(vantage_precompiled PRIVATE ${VANTAGE_COMMON_HEADERS})
endfunction()

# vantage_library(NAME SOURCES file... PUBLIC target... PRIVATE target...)
#
# A module: the shared library vantage_NAME, the target vantage::NAME, and its own include folder,
# so that an include in the wrong direction does not compile.
function(vantage_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target vantage_${name})
  add_library(${target} SHARED ${arg_SOURCES})
  add_library(vantage::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name} VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}  # before 1.0 minor versions differ
    DEFINE_SYMBOL "")  # one more macro would spoil precompiled headers that modules share
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(${target} PRIVATE src)
  # Templates of std and OpenVDB would show their symbols in spite of hidden visibility.
  set(exports "${PROJECT_SOURCE_DIR}/cmake/exports.map")
  target_link_options(${target} PRIVATE "LINKER:--version-script=${exports}")
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS "${exports}")
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC}
                        PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:vantage_options>)
  set_property(GLOBAL APPEND PROPERTY VANTAGE_MODULES ${target})
endfunction()
