/* The extension module carom._objects: many Python objects of one class from columns of their
 * attributes, without a call of Python for each. Attributes are set as object.__setattr__() sets
 * them; no __init__() runs. */
#define PY_SSIZE_T_CLEAN
#include <Python.h>

/* Whether zeros are a valid object of a class, as in one written in Python whose bases are too,
 * but for object. A class with a __new__() of its own, or of a base such as dict, needs that.
 * Otherwise an exception is set. */
static int zeros_will_do(PyObject *type) {
  if (PyType_GetSlot((PyTypeObject *)type, Py_tp_new) ==
      PyType_GetSlot(&PyBaseObject_Type, Py_tp_new))
    return 1;
  PyErr_SetString(PyExc_TypeError,
                  "type: a class that is written in Python and has no __new__() is needed");
  return 0;
}

/* Gives object k its attributes: names[j] is item k of columns[j] where that is a list,
 * otherwise columns[j] itself. */
static int set_row(PyObject *object, PyObject *names, PyObject *columns, Py_ssize_t k) {
  for (Py_ssize_t j = 0; j < PyTuple_Size(names); j++) {
    PyObject *name = PyTuple_GetItem(names, j), *value = PyTuple_GetItem(columns, j);
    if (value != NULL && PyList_Check(value))
      value = PyList_GetItem(value, k);
    if (value == NULL || PyObject_GenericSetAttr(object, name, value) < 0)
      return -1;
  }
  return 0;
}

static PyObject *make(PyObject *module, PyObject *arguments) {
  PyObject *type, *names, *columns;
  Py_ssize_t n;
  (void)module;
  if (!PyArg_ParseTuple(arguments, "O!nO!O!", &PyType_Type, &type, &n, &PyTuple_Type, &names,
                        &PyTuple_Type, &columns) ||
      !zeros_will_do(type))
    return NULL;
  if (n < 0) {
    PyErr_SetString(PyExc_ValueError, "n: it must not be negative");
    return NULL;
  }
  PyObject *objects = PyList_New(n);
  for (Py_ssize_t k = 0; k < n && objects != NULL; k++) {
    PyObject *object = PyType_GenericAlloc((PyTypeObject *)type, 0);
    if (object == NULL || PyList_SetItem(objects, k, object) < 0 ||
        set_row(object, names, columns, k) < 0)
      Py_CLEAR(objects);
  }
  return objects;
}

static PyObject *turn(PyObject *module, PyObject *arguments) {
  PyObject *objects, *type, *names, *columns, *attribute = NULL;
  (void)module;
  if (!PyArg_ParseTuple(arguments, "O!O!O!O!", &PyList_Type, &objects, &PyType_Type, &type,
                        &PyTuple_Type, &names, &PyTuple_Type, &columns) ||
      (attribute = PyUnicode_InternFromString("__class__")) == NULL)
    return NULL;
  int good = 1;
  for (Py_ssize_t k = 0; k < PyList_Size(objects) && good; k++) {
    PyObject *object = PyList_GetItem(objects, k);
    if (Py_TYPE(object) != (PyTypeObject *)type)
      good = PyObject_GenericSetAttr(object, attribute, type) == 0 &&
             set_row(object, names, columns, k) == 0;
  }
  Py_DECREF(attribute);
  return good ? Py_NewRef(Py_None) : NULL;
}

static PyMethodDef methods[] = {{"make", make, METH_VARARGS,
                                 "make(type, n, names, columns): a list of n objects of a class "
                                 "written in Python. Attribute names[j] of object k is "
                                 "columns[j]"
                                 "[k] where\nthat column is a list, otherwise columns[j] itself."},
                                {"turn", turn, METH_VARARGS,
                                 "turn(objects, type, names, columns): those of a list of objects "
                                 "that are of another class become of this one, and get\n"
                                 "attributes as make() gives them."},
                                {NULL, NULL, 0, NULL}};

static struct PyModuleDef definition = {PyModuleDef_HEAD_INIT, .m_name = "carom._objects",
                                        .m_size = 0, .m_methods = methods};

PyMODINIT_FUNC PyInit__objects(void) {
  return PyModule_Create(&definition);
}
