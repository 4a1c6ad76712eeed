# SPDX-License-Identifier: Apache-2.0
# Code that can influence a trajectory must not link a function of <math.h> whose last digit differs between platforms.
# The cause may be a header, a builtin or an optimisation. Exact functions are allowed: sqrt, floor, fabs, fmin, fmax,
# fmod and similar ones.
#   cmake -DNM=nm -DOBJECTS=a.o,b.a -P undefined_functions.cmake
string(REPLACE "," ";" OBJECTS "${OBJECTS}")
if(NOT OBJECTS)
  message(FATAL_ERROR "no objects given")
endif()
set(inexact "a?(sin|cos|tan)h?|atan2|(sin|cos|tan|asin|acos|atan|atan2)pi|sincos|exp|exp2|expm1|exp10|pow10|"
            "log|log2|log10|log1p|logb|pow|powi|cbrt|hypot|fma|[lt]gamma|gamma|erfc?|j[01n]|y[01n]")
string(CONCAT inexact ${inexact})
foreach(object IN LISTS OBJECTS)
  execute_process(COMMAND ${NM} -u ${object} OUTPUT_VARIABLE symbols RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${NM} -u ${object} failed")
  endif()
  string(REGEX MATCHALL "[^ \n]+" words "${symbols}")
  foreach(word IN LISTS words)
    # pow, powf, powl, __pow_finite, _ZSt3powdd never reaches the linker: it calls pow.
    if(word MATCHES "^_*(${inexact})[fl]?(_finite|_r)?(@.*)?$")
      list(APPEND found "${object} calls ${word}")
    endif()
  endforeach()
endforeach()
if(found)
  list(JOIN found "\n  " found)
  message(FATAL_ERROR "sixstep/base/elementary.hpp has a function of its own for each of these:\n  ${found}")
endif()
