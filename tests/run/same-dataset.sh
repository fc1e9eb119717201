# same_dataset A B: every picture decodes to the same pixels, every label file has the same bytes.
# Needs ./same-pixels, which is asked where a picture's bytes differ.
same_dataset() {
    ( cd "$1" && find . -path ./frames/home -prune -o -type f -print | sort ) >names
    ( cd "$2" && find . -path ./frames/home -prune -o -type f -print | sort ) >others
    cmp names others || return 1
    same_files "$1" "$2" <names
}
# same_files A B: the same, of the files that are named on standard input.
same_files() {
    while read -r name; do
        case $name in
        *.png|*.exr) cmp -s "$1/$name" "$2/$name" || ./same-pixels "$1/$name" "$2/$name" ;;
        *) cmp "$1/$name" "$2/$name" ;;
        esac || return 1
    done
}
