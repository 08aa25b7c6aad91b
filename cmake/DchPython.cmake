# SPDX-License-Identifier: MIT
# The tests in Python use modules that the distribution installs, and only its own interpreter finds those: another
# one that stands earlier in the PATH (pyenv, conda) has to be asked for with -DPython3_EXECUTABLE=.
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python interpreter of the tests")
endif()
