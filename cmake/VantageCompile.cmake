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
set(CMAKE_CXX_FLAGS_DEBUG "-Og -g")

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE}")
endif()

add_library(vantage_options INTERFACE)
target_compile_options(vantage_options INTERFACE
  -ffp-contract=off  # a fused multiply-add here and not there would make results depend on the kernel
  -fno-math-errno    # nobody reads it, and for its sake square roots would be taken one by one
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<BOOL:${VANTAGE_WERROR}>:-Werror>)
if(VANTAGE_SANITIZE)
  target_compile_options(vantage_options INTERFACE
    -fsanitize=${VANTAGE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(vantage_options INTERFACE -fsanitize=${VANTAGE_SANITIZE})
  # The run-time choice of a kernel runs before the sanitizers are ready.
  target_compile_definitions(vantage_options INTERFACE VANTAGE_ONE_INSTRUCTION_SET)
endif()

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
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})  # before 1.0 minor versions differ
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_include_directories(${target} PRIVATE src)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC}
                        PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:vantage_options>)
  set_property(GLOBAL APPEND PROPERTY VANTAGE_MODULES ${target})
endfunction()
