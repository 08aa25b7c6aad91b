#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Shared by the scripts in the folders beside it; sourced by bash after scripts/_common.sh, never run.

# The mirror that this machine's apt takes Debian from.
debian_mirror() {
  local mirror
  # shellcheck disable=SC2016  # a field that apt-get fills in
  mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Label: Debian' | head -n 1)
  [ -n "$mirror" ] || die "this machine's apt has no index of Debian's packages; run 'apt-get update' as root first"
  printf '%s\n' "$mirror"
}

# debian_system SUITE FOLDER: a Debian of this release in FOLDER/system, in which nothing is installed but whose apt knows what
# there is, and FOLDER/archives for what is downloaded there.
debian_system() {
  local suite=$1 folder=$2
  if [ ! -e "$folder/made" ]; then
    heading "Debian $suite"
    rm -rf "${folder:?}/system"
    mkdir -p "$folder/archives/partial"
    debootstrap --variant=minbase "$suite" "$folder/system" "$(debian_mirror)" >"$folder/debootstrap.log" 2>&1 ||
      { tail -n 20 "$folder/debootstrap.log" >&2; return 1; }
    touch "$folder/made"
  fi
  cp --dereference /etc/resolv.conf "$folder/system/etc/resolv.conf"
  chroot "$folder/system" apt-get update -qq </dev/null
}

# debian_source PACKAGE FOLDER: unpacks what its authors released, as Debian has it for this machine's release, into
# FOLDER/PACKAGE. The system's list of sources stays as it is: apt-get takes one made here.
debian_source() {
  local package=$1 folder=$2 options mirror suite
  [ ! -d "$folder/$package" ] || return 0
  mirror=$(debian_mirror)
  suite=$(. /etc/os-release && printf '%s' "$VERSION_CODENAME")
  mkdir -p "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial"
  printf 'deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] %s %s main\n' "$mirror" "$suite" \
    >"$folder/apt/sources.list"
  options=(-qq -o "Dir::Etc::SourceList=$folder/apt/sources.list" -o Dir::Etc::SourceParts=/dev/null
    -o "Dir::State::Lists=$folder/apt/lists" -o "Dir::Cache=$folder/apt/cache" -o APT::Sandbox::User=root)
  apt-get "${options[@]}" update </dev/null
  (cd "$folder/apt" && apt-get "${options[@]}" source --download-only "$package" </dev/null)
  mkdir -p "$folder/$package.part"
  tar --extract --strip-components 1 --directory "$folder/$package.part" --file "$folder/apt/$package"_*.orig.tar.*
  mv "$folder/$package.part" "$folder/$package"
}
