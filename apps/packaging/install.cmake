# What `cmake --install` puts where, and the Debian packages that cpack makes of it: neumann, the program with its manual and scenes,
# libneumann-dev, the libraries with headers and CMake package, python3-neumann, the Python module, where it is built, and
# libneumann-modules, which these three load to read and write pictures and to read scenes of other programs.
include(CMakePackageConfigHelpers)
set(packaging ${PROJECT_SOURCE_DIR}/apps/packaging)
set(scenes ${CMAKE_INSTALL_DATADIR}/neumann/scenes)

install(TARGETS neumann RUNTIME COMPONENT program)
install(TARGETS neumann-experiments RUNTIME DESTINATION ${NEUMANN_MODULES} COMPONENT program)
install(TARGETS neumann_read_pictures neumann_write_pictures neumann_import_scenes LIBRARY DESTINATION ${NEUMANN_MODULES} COMPONENT modules)
if(NEUMANN_MPI)
  install(TARGETS neumann_mpi neumann_petsc LIBRARY DESTINATION ${NEUMANN_MODULES} COMPONENT program)
endif()
install(FILES ${packaging}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libneumann-modules COMPONENT modules)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes/ DESTINATION ${scenes} COMPONENT program)
install(FILES ${packaging}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# The manual, which the program prints itself: a page a command, and one of all.
find_program(GZIP gzip REQUIRED)
file(GLOB texts CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/apps/manual/*.txt)
set(pages "")
foreach(text ${texts})
  get_filename_component(command ${text} NAME_WE)
  if(command STREQUAL neumann)
    set(page ${PROJECT_BINARY_DIR}/manual/neumann.1)
    set(topic "")
  else()
    set(page ${PROJECT_BINARY_DIR}/manual/neumann-${command}.1)
    set(topic ${command})
  endif()
  add_custom_command(OUTPUT ${page}.gz
    COMMAND neumann help ${topic} --roff > ${page} COMMAND ${GZIP} -9nf ${page} DEPENDS neumann)
  list(APPEND pages ${page}.gz)
endforeach()
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/manual)
add_custom_target(manual ALL DEPENDS ${pages})
install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)

# The libraries.
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/neumann)
set_target_properties(neumann_core PROPERTIES EXPORT_NAME core)
set_target_properties(neumann_operators PROPERTIES EXPORT_NAME operators)
set_target_properties(neumann_solvers PROPERTIES EXPORT_NAME solvers)
set_target_properties(neumann_experiments PROPERTIES EXPORT_NAME experiments)
set_target_properties(neumann_options PROPERTIES EXPORT_NAME options)
install(TARGETS neumann_core neumann_operators neumann_solvers neumann_experiments neumann_options EXPORT neumann ARCHIVE COMPONENT development)
install(EXPORT neumann NAMESPACE neumann:: FILE neumannTargets.cmake DESTINATION ${package} COMPONENT development)
install(DIRECTORY core operators DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/neumann COMPONENT development FILES_MATCHING PATTERN "*.h")
file(RELATIVE_PATH to_scenes /${package} /${scenes})
configure_file(${packaging}/neumannConfig.cmake ${PROJECT_BINARY_DIR}/neumannConfig.cmake @ONLY)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/neumannConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/neumannConfig.cmake ${PROJECT_BINARY_DIR}/neumannConfigVersion.cmake ${packaging}/dependencies.cmake
  DESTINATION ${package} COMPONENT development)
install(FILES ${packaging}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libneumann-dev COMPONENT development)

# One package a component.
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program modules development)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_COMPONENT_PROGRAM_DEPENDS modules)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS modules)
set(CPACK_COMPONENT_PYTHON_DEPENDS modules)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "The neumann authors <neumann@neumann.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME neumann)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS fonts-dejavu-core)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "renders each bounce of light as a picture of its own
 The terms of the Neumann series of the rendering equation are sampled all at
 once, summed, and compared: how large each bounce is, how large the rest is
 that was left out, how certain every pixel is, and how the error falls with
 run time. It reads Mitsuba 3 scenes.")
set(CPACK_DEBIAN_MODULES_PACKAGE_NAME libneumann-modules)
set(CPACK_DEBIAN_MODULES_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_MODULES_PACKAGE_SHLIBDEPS ON)
# Its name in 0.1.
set(CPACK_DEBIAN_MODULES_PACKAGE_REPLACES libneumann-pictures)
set(CPACK_DEBIAN_MODULES_PACKAGE_CONFLICTS libneumann-pictures)
set(CPACK_DEBIAN_MODULES_DESCRIPTION "pictures and scenes of other programs for neumann
 The parts of neumann that read and write pictures and that read scenes of
 glTF, pbrt, COLLADA and Tungsten. Each is loaded when it is first needed, so
 that all else starts at once.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libneumann-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libembree-dev, libglm-dev, libtbb-dev, libpugixml-dev, zlib1g-dev, \
libfmt-dev, libboost-dev, libeigen3-dev, libspectra-dev, librandom123-dev, libxxhash-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "operators of the rendering equation, development files
 Static libraries, headers and CMake package of neumann: scenes, T, R,
 K = R T, the Neumann series, its solvers and its statistics.")
if(NEUMANN_PYTHON)
  # It is compiled for one Python, as packages of Debian's are.
  math(EXPR next_python "${Python_VERSION_MINOR} + 1")
  install(FILES ${packaging}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-neumann COMPONENT python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-neumann)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy, python3-scipy")
  # They compile it, and take what was compiled away with it.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${packaging}/python/postinst;${packaging}/python/prerm")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib, neumann")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "bounces of light as NumPy arrays
 The Python module of neumann: renders, the matrices T and R of a scene, the
 spectrum of K = R T, solvers, series, plans and studies.")
endif()
include(CPack)
