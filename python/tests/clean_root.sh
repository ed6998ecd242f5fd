#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# For the judge: the wheel in a root of its own, a smallest Debian with Python and nothing else
# (debootstrap; root only): no library of this machine, no network. pip installs dist/*.whl there,
# with NumPy and matplotlib; then the lines of docs/start-training.md, the command and the worker
# run. Needs what python/tests/install.sh made. The root is kept, without what was installed, for
# the next run.
set -euo pipefail
cd "$(dirname "$0")/../.."
[ "$(id -u)" = 0 ] || { echo "skipped: debootstrap needs root"; exit 77; }
command -v debootstrap >/dev/null ||
  { echo "skipped: no debootstrap (apt-get install debootstrap)"; exit 77; }
made=$(cat build/wheel/made)
packages=$(readlink -f build/wheel/beside)/wheels
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
kept=${XDG_CACHE_HOME:-$HOME/.cache}/tenon/root-$release
if [ ! -e "$kept/made" ]; then
  rm -rf "$kept"
  debootstrap --variant=minbase --include=python3,python3-venv "$release" "$kept" \
    >build/clean_root.log ||
    { tail -n 5 build/clean_root.log; echo "skipped: debootstrap made no $release"; exit 77; }
  touch "$kept/made"
fi
root=$PWD/build/clean_root
rm -rf "$root"
cp -a "$kept" "$root"
trap 'rm -rf "$root"' EXIT
user=$root/home/reader
mkdir -p "$user/dist" "$user/packages" "$user/examples"
cp "$made" "$user/dist/"
cp "$packages"/*.whl "$user/packages/"
cp -r examples/inspire_hand examples/cpp/robots "$user/examples/"
python3 - docs/start-training.md >"$user/lines.py" <<'END'
import re, sys
(lines,) = re.findall(r"^```python\n(.*?)^```$", open(sys.argv[1]).read(), re.M | re.S)
print(lines)
END
# The user's packages are given by hand, for there is no network.
# With a /proc, as every system has, in a space of mounts that ends with the command.
within() {
  unshare --mount bash -c "mount -t proc proc '$root/proc' && exec \"\$@\"" within \
    chroot "$root" /usr/bin/env -i HOME=/home/reader PATH=/usr/bin:/bin LANG=C.UTF-8 \
    MPLBACKEND=agg \
    bash -euc "cd /home/reader; $1"
}
within 'python3 -m venv own
own/bin/pip install --quiet --disable-pip-version-check --no-index --find-links packages \
  dist/*.whl matplotlib'
within 'own/bin/python lines.py' | tee build/clean_root.txt
grep -q "/World/can 0\." build/clean_root.txt
[ -s "$user/heights.png" ]
within 'own/bin/tenon check examples/inspire_hand/inspire_hand.usda >/dev/null
for engine in mujoco physx jolt; do
  own/bin/tenon sim examples/inspire_hand/grasp.usda --engine $engine --duration 0.05 -q \
    -o $engine.csv || [ $? = 1 ] # not at rest so soon
  [ -s $engine.csv ]
done
own/bin/tenon convert examples/robots/arm.urdf arm >/dev/null
own/bin/tenon convert examples/inspire_hand/inspire_hand.usda hand.xml --physics mujoco >/dev/null
own/bin/tenon convert hand.xml again >/dev/null # by MuJoCo in the worker
own/bin/tenon report examples/inspire_hand/inspire_hand.usda -o hand.html >/dev/null'
[ -s "$user/hand.html" ]
count=$(chroot "$root" dpkg-query -W | wc -l)
size=$(stat -c %s "$made" | awk '{printf "%.1f", $1 / 1e6}')
echo "Python lines, 3 engines and the worker in a $release of $count packages, wheel $size MB"
