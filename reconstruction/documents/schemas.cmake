# Puts assets/schema/*.schema.json into the binary: VANTAGE_SCHEMAS_CPP is the source to compile.
# A change of a schema runs this again with the next build.
foreach(name workcell knowledge plan world observation evaluation planning shadow_filters replay tracking reasoning sequence views stability)
  set(file "${PROJECT_SOURCE_DIR}/assets/schema/${name}.schema.json")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  file(READ "${file}" ${name}_schema)
endforeach()
set(VANTAGE_SCHEMAS_CPP "${CMAKE_CURRENT_BINARY_DIR}/schemas.cpp")
configure_file(schemas.cpp.in "${VANTAGE_SCHEMAS_CPP}" @ONLY)
