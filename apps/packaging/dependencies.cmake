# What the libraries core and operators need: included by the build, and by find_package(neumann) of whoever uses them.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3.13 REQUIRED)
endif()
find_package(Boost 1.74 REQUIRED CONFIG)
find_package(TBB 2021 REQUIRED)
find_package(fmt REQUIRED)
find_package(pugixml REQUIRED)
find_package(ZLIB REQUIRED)
find_package(Eigen3 3.4 REQUIRED)

# Libraries that are headers alone.
find_path(GLM_INCLUDE_DIR glm/glm.hpp REQUIRED)
find_path(RANDOM123_INCLUDE_DIR Random123/philox.h REQUIRED)
find_path(SPECTRA_INCLUDE_DIR Spectra/GenEigsSolver.h REQUIRED)
find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
if(NOT TARGET neumann::headers)
  add_library(neumann::headers INTERFACE IMPORTED)
  target_include_directories(neumann::headers INTERFACE
    ${GLM_INCLUDE_DIR} ${RANDOM123_INCLUDE_DIR} ${SPECTRA_INCLUDE_DIR} ${XXHASH_INCLUDE_DIR})
endif()
