# Shared by the scripts in this folder; sourced, not run.

step() { printf '\n\033[1m== %s\033[0m\n' "$*"; }

# install_packages NAME...: Debian packages; does nothing, and asks for nothing, when all are there.
install_packages() {
    local missing=()
    for package in "$@"; do
        dpkg-query --show --showformat='${Status}' "$package" 2>/dev/null |
            grep --quiet 'ok installed' || missing+=("$package")
    done
    if [ ${#missing[@]} -eq 0 ]; then
        echo "all packages are there: $*"
        return
    fi
    local as_root=()
    if [ "$(id --user)" -ne 0 ]; then
        command -v sudo >/dev/null || {
            echo "error: these packages are missing and there is no sudo: ${missing[*]}" >&2
            exit 1
        }
        as_root=(sudo)
    fi
    echo "installing: ${missing[*]}"
    "${as_root[@]}" apt-get update --quiet=2
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install --quiet=2 --yes --no-install-recommends "${missing[@]}" >/dev/null
}

build_packages=(g++ cmake ninja-build antlr4 libantlr4-runtime-dev libcli11-dev libfmt-dev
    libeigen3-dev libutf8proc-dev nlohmann-json3-dev libcpp-httplib-dev libcairo2-dev libpng-dev libgif-dev
    fonts-dejavu-core pkg-config)
# What the build of the tests needs besides, and what they need when they run.
test_build_packages=(libgtest-dev libgmock-dev librandom123-dev libboost-dev clang lld python3 python3-dev python3-venv
    libopenmpi-dev openmpi-bin)
test_packages=(ccache clang-format chromium neovim ffmpeg locales)
