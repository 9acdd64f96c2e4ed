# SPDX-License-Identifier: GPL-3.0-or-later
# PGDR_PYTHON: an interpreter of Python 3, if possible one that has meshio and VTK (the distribution's packages
# are seen by the distribution's interpreter only, which need not be the first in $PATH).
# Looked for again at every configuration, since packages come and go; -DPGDR_PYTHON=... settles it.

if(NOT PGDR_PYTHON)
  find_program(PGDR_PYTHON_IN_PATH python3)
  mark_as_advanced(PGDR_PYTHON_IN_PATH)
  foreach(modules IN ITEMS "meshio, vtkmodules" meshio sys)
    foreach(candidate IN ITEMS ${PGDR_PYTHON_IN_PATH} /usr/bin/python3)
      if(NOT PGDR_PYTHON AND EXISTS "${candidate}")
        execute_process(COMMAND ${candidate} -c "import ${modules}" RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
        if(NOT failed)
          set(PGDR_PYTHON ${candidate})
        endif()
      endif()
    endforeach()
  endforeach()
endif()
