# Installs the build into a folder of its own, looks what came, and builds and runs the project beside this file against it.
# cmake -DBUILD=… -DCXX=… -DFOLDER=… -P install.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE out)
  set(out "${out}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/usr)
set(neumann ${FOLDER}/usr/bin/neumann)

# A manual page for every command, with its name and summary.
run(${neumann} help)
string(REGEX MATCH "COMMANDS\n.*\nOPTIONS" commands "${out}")
string(REGEX MATCHALL "\n  [a-z]+\n" commands "${commands}")
list(LENGTH commands count)
if(count LESS 10)
  message(FATAL_ERROR "neumann help names ${count} commands only:\n${out}")
endif()
file(GLOB pages RELATIVE ${FOLDER}/usr/share/man/man1 ${FOLDER}/usr/share/man/man1/*)
set(expected neumann.1.gz)
foreach(command ${commands})
  string(STRIP "${command}" command)
  list(APPEND expected neumann-${command}.1.gz)
endforeach()
list(SORT expected)
list(SORT pages)
if(NOT expected STREQUAL pages)
  message(FATAL_ERROR "manual pages: ${pages}, expected ${expected}")
endif()
foreach(page ${pages})
  run(gzip -dc ${FOLDER}/usr/share/man/man1/${page})
  string(REGEX REPLACE "\\.1\\.gz" "" name ${page})
  string(REPLACE "-" "\\-" name ${name})
  string(FIND "${out}" ".SH NAME\n.PP\n${name} \\- " found)
  if(found EQUAL -1)
    message(FATAL_ERROR "${page} does not begin with ${name}:\n${out}")
  endif()
endforeach()

# The program and a scene, away from the repository.
run(${neumann} render ${FOLDER}/usr/share/neumann/scenes/furnace/furnace.xml -o ${FOLDER}/out -n 1 --spp 1 -D res=4 --quiet)
# By the program of the experiments.
run(${neumann} spectrum furnace --patches 6 --directions 4 --quiet)
if(NOT EXISTS ${FOLDER}/out/run.json)
  message(FATAL_ERROR "the installed program rendered nothing")
endif()

# The libraries.
run(${CMAKE_COMMAND} -G Ninja -S ${CMAKE_CURRENT_LIST_DIR} -B ${FOLDER}/build -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_CXX_FLAGS=${FLAGS}
  -DCMAKE_PREFIX_PATH=${FOLDER}/usr)
run(${CMAKE_COMMAND} --build ${FOLDER}/build --target run)
string(FIND "${out}" "bounce 6: 0.117649" found)
if(found EQUAL -1)
  message(FATAL_ERROR "0.7^6 was expected:\n${out}")
endif()
string(FIND "${out}" "picture 4: 0.0625" found)
if(found EQUAL -1)
  message(FATAL_ERROR "0.5^4 was expected:\n${out}")
endif()
file(REMOVE_RECURSE ${FOLDER})
