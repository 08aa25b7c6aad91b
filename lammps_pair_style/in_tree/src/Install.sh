# SPDX-License-Identifier: GPL-2.0-or-later
# How the traditional make puts the package DCH into LAMMPS/src and takes it out again. It calls this in src/DCH, after
# it has made Makefile.package and Makefile.package.settings:
#
#   sh Install.sh 1    put in (make yes-dch)
#   sh Install.sh 0    take out (make no-dch)
#   sh Install.sh 2    bring up to date what is in (make package-update)

mode=$1
words='PKG_INC=-I../../lib/dch/core/include PKG_INC=-I../../lib/dch/forces/include PKG_INC=-I../../lib/dch/necklace/include PKG_PATH=-L../../lib/dch
  PKG_LIB=-ldch_core PKG_LIB=-ldch_forces PKG_LIB=-ldch_necklace PKG_SYSLIB=$(dch_SYSLIB)'
settings='include ../../lib/dch/Makefile.lammps'

put_in() {
  for file in *.cpp *.h; do
    cmp -s "$file" "../$file" && continue
    cp -p "$file" ..
    [ "$mode" = 1 ] || echo "  updating src/$file"
  done
}

take_out() {
  for file in *.cpp *.h; do rm -f "../$file"; done
}

# A word is taken out with the blank before it, so that putting it in and taking it out leaves the file as it was.
forget_library() {
  for word in $words; do
    pattern=$(printf '%s' "${word#*=}" | sed -e 's/[.$]/\\&/g')
    sed -i -e "/^${word%%=*} *=/s| $pattern\\( \\)| |; /^${word%%=*} *=/s| $pattern\$||" ../Makefile.package
  done
  grep -v -x -F -e "$settings" ../Makefile.package.settings >../Makefile.package.settings.new
  mv ../Makefile.package.settings.new ../Makefile.package.settings
}

name_library() {
  for word in $words; do
    sed -i -e "s|^${word%%=*} *=|& ${word#*=}|" ../Makefile.package
  done
  echo "$settings" >>../Makefile.package.settings
}

case $mode in
  0) take_out && forget_library ;;
  1) put_in && forget_library && name_library ;;
  2) put_in ;;
  *) echo "Install.sh: '$mode' is none of 0, 1, 2" >&2; exit 2 ;;
esac
