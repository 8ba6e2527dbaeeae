// SPDX-License-Identifier: BSD-3-Clause
// Conversions of rotations over arrays of rows; gyrostat/rotation.py broadcasts. Quaternions are scalar-last here.
#include "bind.hpp"
#include "convert.hpp"
#include "gil.hpp"
#include "gyrostat/rotation/euler_312.hpp"
#include "gyrostat/rotation/exp_log.hpp"
#include "gyrostat/rotation/quaternion.hpp"

namespace {

using namespace gyrostat;
using namespace gyrostat::python;

Quat<double> quaternion(const double* p) { return {p[3], p[0], p[1], p[2]}; }
Mat3<double> matrix(const double* p) {
  Mat3<double> m;
  m << p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7], p[8];
  return m;
}
Vec3<double> vector3(const double* p) { return {p[0], p[1], p[2]}; }

void put(const Quat<double>& q, double* out) {
  out[0] = q.x;
  out[1] = q.y;
  out[2] = q.z;
  out[3] = q.w;
}
void put(const Mat3<double>& m, double* out) {
  for (int i = 0; i < 9; ++i) out[i] = m(i / 3, i % 3);
}
void put(const Vec3<double>& v, double* out) {
  for (int i = 0; i < 3; ++i) out[i] = v[i];
}

/// Rows of `from` numbers to rows of `to` numbers.
template <py::ssize_t from, py::ssize_t to, class Convert>
auto rows(Convert convert) {
  return [convert](const Array& values) {
    require_shape("rows", values, {-1, from});
    const py::ssize_t n = values.shape(0);
    std::vector<double> out(std::size_t(n * to));
    {
      const Unlocked free;
      for (py::ssize_t i = 0; i < n; ++i) put(convert(values.data() + i * from), &out[std::size_t(i * to)]);
    }
    return array(std::move(out), {n, to});
  };
}

}  // namespace

void bind_rotation(pybind11::module_& module) {
  module.def("matrix_from_quaternion", rows<4, 9>([](const double* p) { return to_matrix(normalised(quaternion(p))); }),
             py::arg("rows"));
  module.def("quaternion_from_matrix", rows<9, 4>([](const double* p) { return from_matrix(matrix(p)); }),
             py::arg("rows"));
  module.def("vector_from_quaternion",
             rows<4, 3>([](const double* p) { return vector_from_quaternion(normalised(quaternion(p))); }),
             py::arg("rows"));
  module.def("quaternion_from_vector", rows<3, 4>([](const double* p) { return quaternion_from_vector(vector3(p)); }),
             py::arg("rows"));
  module.def("vector_from_matrix", rows<9, 3>([](const double* p) { return vector_from_matrix(matrix(p)); }),
             py::arg("rows"));
  module.def("euler_312_from_quaternion",
             rows<4, 3>([](const double* p) { return angles_312(normalised(quaternion(p))); }), py::arg("rows"));
  module.def("quaternion_from_euler_312",
             rows<3, 4>([](const double* p) { return quaternion_from_312(p[0], p[1], p[2]); }), py::arg("rows"));
  module.def("matrix_from_vector", rows<3, 9>([](const double* p) { return matrix_from_vector(vector3(p)); }),
             py::arg("rows"));
}
