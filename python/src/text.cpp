// SPDX-License-Identifier: BSD-3-Clause
// Columns of numbers as text, for JSON and CSV.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "bind.hpp"
#include "convert.hpp"
#include "gil.hpp"

namespace gyrostat::python {
namespace {

/// Most characters of a number: -2.2250738585072014e-308.
constexpr std::size_t longest = 24;

/// Writes the shortest decimal that reads back as the same double, laid out as Python's repr does; what stands behind it.
char* put(char* at, double value) noexcept {
  if (std::isnan(value)) return std::copy_n("nan", 3, at);  // never -nan
  const double size = std::abs(value);
  const bool fixed = size == 0 || (size >= 1e-4 && size < 1e16) || std::isinf(value);
  at = std::to_chars(at, at + longest, value, fixed ? std::chars_format::fixed : std::chars_format::scientific).ptr;
  return fixed && value == std::trunc(value) && !std::isinf(value) ? std::copy_n(".0", 2, at) : at;
}

/// A text of Python that is written in place, as one of some hundred megabytes is not to be copied.
class Text {
 public:
  explicit Text(std::size_t room) : object_(PyUnicode_New(py::ssize_t(room), 127)) {
    if (object_ == nullptr) throw py::error_already_set();
  }
  char* begin() const noexcept { return static_cast<char*>(PyUnicode_DATA(object_)); }
  /// What was written up to `end`.
  py::str until(const char* end) && {
    if (PyUnicode_Resize(&object_, end - begin()) != 0) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(object_);
  }

 private:
  PyObject* object_;
};

/// (n,) as an array, (n, width) as an array of arrays; null for what is not finite.
py::str json_numbers(const Array& values) {
  const bool nested = values.ndim() == 2;
  if (values.ndim() != 1 && !nested) raise("DomainError", "values: the shape is neither (n,) nor (n, width)");
  const py::ssize_t rows = values.shape(0), width = nested ? values.shape(1) : 1;
  const double* value = values.data();
  Text text(std::size_t(rows) * (std::size_t(width) * (longest + 2) + 4) + 2);
  char* at = text.begin();
  {
    const Unlocked free;
    *at++ = '[';
    for (py::ssize_t row = 0; row < rows; ++row) {
      if (row > 0) at = std::copy_n(", ", 2, at);
      if (nested) *at++ = '[';
      for (py::ssize_t i = 0; i < width; ++i, ++value) {
        if (i > 0) at = std::copy_n(", ", 2, at);
        at = std::isfinite(*value) ? put(at, *value) : std::copy_n("null", 4, at);
      }
      if (nested) *at++ = ']';
    }
    *at++ = ']';
  }
  return std::move(text).until(at);
}

/// A column of a table: rows of `width` numbers, or of one word of at most `length` bytes.
struct CsvColumn {
  Array numbers;
  py::array words;
  py::ssize_t rows = 0, width = 1, length = 0;

  explicit CsvColumn(const py::array& values) {
    const bool is_words = values.dtype().kind() == 'S';
    if (is_words) words = py::array::ensure(values, py::array::c_style);
    else numbers = Array::ensure(values);
    if (values.ndim() < 1 || values.ndim() > (is_words ? 1 : 2) || !(is_words ? bool(words) : bool(numbers)))
      raise("DomainError", "columns: wanted are arrays (n,) or (n, width) of numbers, or (n,) of bytes");
    rows = values.shape(0);
    if (values.ndim() == 2) width = values.shape(1);
    if (is_words) length = values.itemsize();
  }

  /// Most characters of a row, each cell with its separator.
  std::size_t row_length() const { return std::size_t(length > 0 ? length : width * py::ssize_t(longest + 1)) + 1; }

  /// Writes a row; what stands behind it.
  char* put_row(char* at, py::ssize_t row) const {
    if (length > 0) {
      const char* word = static_cast<const char*>(words.data()) + row * length;
      return std::copy_n(word, ::strnlen(word, std::size_t(length)), at);
    }
    for (py::ssize_t i = 0; i < width; ++i) {
      if (i > 0) *at++ = ',';
      at = put(at, numbers.data()[row * width + i]);
    }
    return at;
  }
};

/// The rows of a table, without its head.
py::str csv_rows(const py::typing::List<py::array>& given) {
  std::vector<CsvColumn> columns;
  for (const py::handle column : given) columns.emplace_back(column.cast<py::array>());
  const py::ssize_t rows = columns.empty() ? 0 : columns[0].rows;
  std::size_t row_length = 0;
  for (const CsvColumn& column : columns) {
    if (column.rows != rows) raise("DomainError", "columns: they have different numbers of rows");
    row_length += column.row_length();
  }
  Text text(std::size_t(rows) * row_length);
  char* at = text.begin();
  {
    const Unlocked free;
    for (py::ssize_t row = 0; row < rows; ++row)
      for (const CsvColumn& column : columns) {
        at = column.put_row(at, row);
        *at++ = &column == &columns.back() ? '\n' : ',';
      }
  }
  return std::move(text).until(at);
}

}  // namespace
}  // namespace gyrostat::python

void bind_text(pybind11::module_& module) {
  using namespace gyrostat::python;
  module.def(
      "json_numbers", &json_numbers, py::arg("values"),
      "An array (n,) or (n, width) as JSON; every number reads back as the same double, what is not finite is null.");
  module.def("csv_rows", &csv_rows, py::arg("columns"),
             "The rows of a table of columns (n,) or (n, width) of numbers, or (n,) of bytes, as CSV without a head.");
}
