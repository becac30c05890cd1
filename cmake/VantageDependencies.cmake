# Everything comes from Debian's packages; apps/setup.sh installs them.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(PNG REQUIRED)
find_package(assimp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Qhull REQUIRED)
find_package(nanoflann REQUIRED)

# Debian 12 has Embree 3.13, Debian 13 has 4.3: raycore/src/scene/embree.hpp hides the difference.
find_package(embree REQUIRED)
if(NOT EMBREE_VERSION_MAJOR MATCHES "^[34]$")
  message(FATAL_ERROR "Embree ${EMBREE_VERSION} found; vantage is written for Embree 3 and 4")
endif()
add_library(vantage_embree INTERFACE)
target_link_libraries(vantage_embree INTERFACE embree)
target_compile_definitions(vantage_embree INTERFACE VANTAGE_EMBREE_MAJOR=${EMBREE_VERSION_MAJOR})

# OpenVDB ships a find module instead of a package file.
find_path(VANTAGE_OPENVDB_MODULE FindOpenVDB.cmake
          PATHS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB REQUIRED)
list(APPEND CMAKE_MODULE_PATH "${VANTAGE_OPENVDB_MODULE}")
find_package(OpenVDB REQUIRED COMPONENTS openvdb)

# Debian 12 has the marker dictionaries in `aruco`, Debian 13 in `objdetect`.
find_package(OpenCV REQUIRED COMPONENTS core imgcodecs imgproc calib3d objdetect aruco)

# Depth as OpenEXR.
find_package(OpenEXR 3 CONFIG REQUIRED)
# Calibrations as OpenCV's XML.
find_package(pugixml REQUIRED)

# Ceres' headers are not free of the warnings that ours have to be.
find_package(Ceres REQUIRED)
add_library(vantage_ceres INTERFACE)
target_link_libraries(vantage_ceres INTERFACE Ceres::ceres)
get_target_property(ceres_includes Ceres::ceres INTERFACE_INCLUDE_DIRECTORIES)
target_include_directories(vantage_ceres SYSTEM INTERFACE ${ceres_includes})

find_package(valijson REQUIRED)

# libyaml has neither a package file nor a find module.
find_path(VANTAGE_YAML_INCLUDE yaml.h REQUIRED)
find_library(VANTAGE_YAML_LIBRARY yaml REQUIRED)
add_library(vantage_yaml INTERFACE)
target_include_directories(vantage_yaml SYSTEM INTERFACE "${VANTAGE_YAML_INCLUDE}")
target_link_libraries(vantage_yaml INTERFACE "${VANTAGE_YAML_LIBRARY}")

# COIN-OR's linear programmes (EPL; GLPK is under the GPL: nothing that is installed may link it).
# It has no package file for CMake.
find_path(VANTAGE_CLP_INCLUDE coin/Clp_C_Interface.h REQUIRED)
find_library(VANTAGE_CLP_LIBRARY Clp REQUIRED)
add_library(vantage_clp INTERFACE)
target_include_directories(vantage_clp SYSTEM INTERFACE "${VANTAGE_CLP_INCLUDE}")
target_link_libraries(vantage_clp INTERFACE "${VANTAGE_CLP_LIBRARY}")
