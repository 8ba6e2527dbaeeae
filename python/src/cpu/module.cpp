// SPDX-License-Identifier: BSD-3-Clause
// The extension module gyrostat._cpu, which gyrostat/cpu.py asks before it loads a module that this processor may not run.
#include <Python.h>

#include "level.hpp"

namespace {

PyModuleDef definition = {
    PyModuleDef_HEAD_INIT, "_cpu", "The processor at hand.", -1, nullptr, nullptr, nullptr, nullptr, nullptr};

}  // namespace

PyMODINIT_FUNC PyInit__cpu() {
  PyObject* module = PyModule_Create(&definition);
  if (module != nullptr && PyModule_AddIntConstant(module, "highest_level", highest_level()) < 0) {
    Py_DECREF(module);
    return nullptr;
  }
#ifdef Py_GIL_DISABLED
  PyUnstable_Module_SetGIL(module, Py_MOD_GIL_NOT_USED);
#endif
  return module;
}
