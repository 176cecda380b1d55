# find_package(neumann): the libraries neumann::core, neumann::operators and neumann::experiments, and NEUMANN_SCENES, the folder of the scenes.
include(${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/neumannTargets.cmake)
get_filename_component(NEUMANN_SCENES ${CMAKE_CURRENT_LIST_DIR}/@to_scenes@ ABSOLUTE)
