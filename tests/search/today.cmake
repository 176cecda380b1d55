# Today's third of the first ninety-nine scenes. cmake -DSEARCH=… -DFOLDER=… -DKNOWN=… -P today.cmake
if(DEFINED ENV{NEUMANN_TEST_DAY})
  set(day $ENV{NEUMANN_TEST_DAY})
else()
  string(TIMESTAMP seconds %s UTC)
  math(EXPR day "${seconds} / 86400")
endif()
math(EXPR first "${day} % 3 * 33 + 1")
execute_process(COMMAND ${SEARCH} --first ${first} --count 33 --folder ${FOLDER} --known ${KNOWN} COMMAND_ERROR_IS_FATAL ANY)
