# SPDX-License-Identifier: Apache-2.0
# The symbols prove that the code is freestanding: -ffreestanding alone accepts any header. Objects of the controller
# may have no undefined symbols except the memory functions that a compiler itself inserts.
string(REPLACE "," ";" OBJECTS "${OBJECTS}")
if(NOT OBJECTS)
  message(FATAL_ERROR "no objects given")
endif()
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} -u ${object} OUTPUT_VARIABLE symbols RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${NM} -u ${object} failed")
  endif()
  string(REGEX MATCHALL "[A-Za-z_][A-Za-z0-9_]+" names "${symbols}")
  list(REMOVE_ITEM names memcpy memmove memset _GLOBAL_OFFSET_TABLE_)
  if(names)
    message(FATAL_ERROR "${object} needs ${names}")
  endif()
endforeach()
