# shellcheck shell=bash
# Sourced by game_demo/run and tests/run: what both need before a program can run.
# Packages and why they are needed: .ci/packages.
root=${root:?the folder of the checkout}

say() { printf '%s\n' "$*" >&2; }

fail() {
    say "error: $*"
    exit 1
}

# missing_packages ROLE...: the lines of .ci/packages, comments left out, that are not installed.
missing_packages() {
    local installed role package needed_by why
    installed=" $(dpkg-query -W -f '${db:Status-Abbrev}${Package}\n' 2>/dev/null |
        sed -n 's/^ii *//p' | tr '\n' ' ')"
    while read -r package needed_by why; do
        [[ -z $package || $package == \#* || $installed == *" $package "* ]] && continue
        for role in "$@"; do
            if [[ $role == "$needed_by" ]]; then
                printf '%-24s %s\n' "$package" "$why"
            fi
        done
    done <"$root/.ci/packages"
}

# require_packages INSTALL ROLE...: lists what is missing and why, then installs it (INSTALL = yes)
# or ends with status 3 (INSTALL = no). Silent where nothing is missing.
require_packages() {
    local install=$1 missing
    shift
    if ! command -v dpkg-query >/dev/null; then
        say "note: no dpkg here, so packages are not checked; .ci/packages lists what is needed"
        return 0
    fi
    missing=$(missing_packages "$@")
    [[ -z $missing ]] && return 0
    say "missing packages:"
    say "  ${missing//$'\n'/$'\n'  }"
    if [[ $install == no ]]; then
        say "run again without --no-install to install them with apt-get"
        exit 3
    fi
    mapfile -t missing < <(cut -d' ' -f1 <<<"$missing")
    install_packages "${missing[@]}"
}

install_packages() {
    local as_root=()
    if [[ $EUID -ne 0 ]]; then
        command -v sudo >/dev/null || fail "installing needs root or sudo; as root: apt-get install $*"
        as_root=(sudo)
    fi
    as_root+=(env DEBIAN_FRONTEND=noninteractive)
    say "installing with apt-get ..."
    "${as_root[@]}" apt-get update -q >&2 || say "note: apt-get update failed in part; trying all the same"
    "${as_root[@]}" apt-get install -y -q --no-install-recommends "$@" >&2 ||
        fail "apt-get could not install: $*"
}

# configure OPTION...: the release preset, only where build/ is not yet configured that way.
configure() {
    local option key stale=no
    [[ -f $root/build/build.ninja ]] || stale=yes
    for option in "$@"; do
        key=${option#-D}
        grep -qs "^${key%%=*}:BOOL=${key#*=}\$" "$root/build/CMakeCache.txt" || stale=yes
    done
    [[ $stale == no ]] && return 0
    (cd "$root" && cmake --preset release "$@" >&2) || fail "the build could not be configured"
}

# build TARGET...: ninja says "no work to do" where everything is up to date.
build() {
    ninja -C "$root/build" "$@" >&2 || fail "the build failed"
}
