# Makes the Debian packages, and looks what is in them and what they depend on. cmake -DBUILD=… -DFOLDER=… -DPYTHON=…
# -P packages.cmake, with PYTHON true where the module is built.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE ${FOLDER})
execute_process(COMMAND ${CMAKE_CPACK_COMMAND} --config ${BUILD}/CPackConfig.cmake -B ${FOLDER} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)

# The one package NAME_….deb has each of the fields (regular expressions) and, of the files, those that begin the lines `files`.
function(expect name fields files)
  file(GLOB package ${FOLDER}/${name}_*.deb)
  list(LENGTH package count)
  if(NOT count EQUAL 1)
    message(FATAL_ERROR "${count} packages ${name}")
  endif()
  execute_process(COMMAND dpkg-deb --info ${package} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE info)
  execute_process(COMMAND dpkg-deb --contents ${package} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE contents)
  foreach(field ${fields})
    if(NOT info MATCHES "\n ${field}")
      message(FATAL_ERROR "${name} has no ${field}:\n${info}")
    endif()
  endforeach()
  foreach(path ${files})
    string(FIND "${contents}" " ./usr/${path}\n" found)
    if(found EQUAL -1)
      message(FATAL_ERROR "${name} has no /usr/${path}:\n${contents}")
    endif()
  endforeach()
  if(NOT contents MATCHES "^drwxr-xr-x root/root")
    message(FATAL_ERROR "${name}: what is in it does not belong to root:\n${contents}")
  endif()
endfunction()

expect(neumann
  "Package: neumann\n;Section: graphics\n;Depends: [^\n]*libneumann-modules \\(= [^\n]*libembree;Recommends: fonts-dejavu-core\n"
  "bin/neumann;lib/neumann/neumann-experiments;share/man/man1/neumann.1.gz;share/man/man1/neumann-render.1.gz;share/doc/neumann/copyright;share/neumann/scenes/cornell-box/cornell-box.xml")
expect(libneumann-modules
  "Package: libneumann-modules\n;Section: libs\n;Depends: [^\n]*libopenexr[^\n]*libopenimageio" "lib/neumann/libneumann_import_scenes.so;share/doc/libneumann-modules/copyright")
expect(libneumann-dev
  "Package: libneumann-dev\n;Section: libdevel\n;Depends: [^\n]*libembree-dev"
  "include/neumann/core/scene/scene.h;include/neumann/operators/algebra/neumann_series.h;share/doc/libneumann-dev/copyright")
if(PYTHON)
  expect(python3-neumann
    "Package: python3-neumann\n;Section: python\n;Depends: [^\n]*libneumann-modules[^\n]*python3-numpy, python3-scipy, [^\n]*libembree;Recommends: python3-matplotlib"
    "lib/python3/dist-packages/neumann/__init__.py;lib/python3/dist-packages/neumann/py.typed;share/doc/python3-neumann/copyright")
endif()
file(REMOVE_RECURSE ${FOLDER})
