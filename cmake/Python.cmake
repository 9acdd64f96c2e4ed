# SPDX-License-Identifier: GPL-3.0-or-later
# PGDR_PYTHON: an interpreter of Python 3, if possible one that has meshio (the distribution's package
# is seen by the distribution's interpreter only, which need not be the first in $PATH).
# Looked for again at every configuration, since packages come and go; -DPGDR_PYTHON=... settles it.

if(NOT PGDR_PYTHON)
  find_program(PGDR_PYTHON_IN_PATH python3)
  mark_as_advanced(PGDR_PYTHON_IN_PATH)
  foreach(candidate IN ITEMS ${PGDR_PYTHON_IN_PATH} /usr/bin/python3)
    if(NOT EXISTS "${candidate}")
      continue()
    endif()
    if(NOT PGDR_PYTHON)
      set(PGDR_PYTHON ${candidate})
    endif()
    execute_process(COMMAND ${candidate} -c "import meshio" RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
    if(NOT failed)
      set(PGDR_PYTHON ${candidate})
      break()
    endif()
  endforeach()
endif()
