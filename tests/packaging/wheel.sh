#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# wheel.sh WHEEL FOLDER: what a user does with the wheel alone. Installed in a virtual environment in FOLDER, which is made anew, it tests
# itself, solves, plots, sweeps and draws a chart; where there are a C++ compiler, CMake and Eigen, programs find the C++ package in it, by CMake and,
# where that is there, by pkg-config. Needs python3 with venv, and the package index for numpy, matplotlib and xarray.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
wheel=$(readlink -f "$1")
folder=$2
rm -rf "$folder" && mkdir -p "$folder"
folder=$(readlink -f "$folder")
cd "$folder"

# step NAME COMMAND...: runs it, its output in a log of that name, and prints how long it took.
step() {
  local name=$1 begin=$SECONDS
  shift
  "$@" >"$name.log" 2>&1 || { tail -n 30 "$name.log"; printf 'FAILED: %s\n' "$*"; exit 1; }
  printf '%4d s  %s: %s\n' $((SECONDS - begin)) "$name" "$(tail -n 1 "$name.log")"
}

# is_picture FILE
is_picture() {
  [ "$(head -c 4 "$1" | tail -c 3)" = PNG ] || { printf 'FAILED: %s is no picture\n' "$1"; exit 1; }
}

there=
for each in c++ cmake; do command -v $each >/dev/null && there="$there $each"; done
for each in gsl sundials_cvode; do ldconfig -p | grep -q "lib$each\." && there="$there lib$each"; done
printf '%s, Python %s; of compiler, CMake, GSL and SUNDIALS there are:%s\n' "$(ldd --version | head -n 1)" \
  "$(python3 -c 'import platform; print(platform.python_version())')" "${there:- none}"

step venv python3 -m venv venv
step install venv/bin/python -m pip install --disable-pip-version-check "$wheel[cli,xarray]"
PATH=$folder/venv/bin:$PATH
step info gyrostat info
step selftest gyrostat selftest
step solve gyrostat solve tiangong-1 --plot answer.png
step integrator gyrostat solve tiangong-1 --set model=full --set integrator=cvode --set duration='1 h'
step chart gyrostat chart t-handle -o chart
step sweep gyrostat sweep stage-despin-study -n 200 -o study.nc
step report gyrostat report study.nc -o study
is_picture answer.png
is_picture chart/chart.png
step python python -c 'import gyrostat; answer = gyrostat.solve("t-handle"); assert answer.met; print(answer.model)'

if command -v c++ >/dev/null && command -v cmake >/dev/null && [ -e /usr/include/eigen3/Eigen/Dense ]; then
  PKG_CONFIG_PATH=$(python -m gyrostat --cmake-dir)/../../pkgconfig
  export PKG_CONFIG_PATH
  step cmake cmake -S "$here/python_package" -B cpp -Dgyrostat_DIR="$(python -m gyrostat --cmake-dir)" -DGYROSTAT_GSL=OFF -DGYROSTAT_CVODE=OFF
  step compile cmake --build cpp --target all readme
  step use ctest --test-dir cpp --output-on-failure --no-tests=error
  step readme cpp/readme
else
  printf '        no C++ compiler, CMake or Eigen: C++ is not tried\n'
fi
printf 'the wheel does what it is for\n'
