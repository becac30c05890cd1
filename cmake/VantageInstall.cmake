# What `cmake --install` lays down: the libraries with their headers, the command, its assets, and
# the package file that makes find_package(vantage) work in another project. The tree may be moved.

include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY VANTAGE_MODULES)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/vantage")

# Libraries find each other beside themselves, the command finds them from bin/.
set_target_properties(${modules} PROPERTIES INSTALL_RPATH "$ORIGIN")
file(RELATIVE_PATH lib_from_command
     "/${CMAKE_INSTALL_LIBEXECDIR}/vantage" "/${CMAKE_INSTALL_LIBDIR}")
set_target_properties(vantage_command PROPERTIES INSTALL_RPATH "$ORIGIN/${lib_from_command}")

install(TARGETS ${modules} EXPORT vantageTargets
        LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
foreach(module IN LISTS modules)
  get_target_property(source_dir ${module} SOURCE_DIR)
  # detail/ is for the modules among themselves.
  install(DIRECTORY "${source_dir}/include/vantage" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
          PATTERN detail EXCLUDE)
endforeach()
install(DIRECTORY assets/schema assets/workcells assets/knowledge DESTINATION "${CMAKE_INSTALL_DATADIR}/vantage")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")

install(EXPORT vantageTargets NAMESPACE vantage:: DESTINATION "${package_dir}")
configure_package_config_file(cmake/vantage-config.cmake.in vantage-config.cmake
                              INSTALL_DESTINATION "${package_dir}"
                              NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(vantage-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/vantage-config.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/vantage-config-version.cmake"
        DESTINATION "${package_dir}")
