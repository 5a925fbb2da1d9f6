# Completion of contactctl for fish. In ~/.config/fish/config.fish:
#   contactctl completion fish | source
function __contactctl_complete
    set -l words (commandline -opc) (commandline -ct)
    set -l word (commandline -ct)
    for line in ($words[1] __complete $words[2..-1] 2>/dev/null)
        switch $line
            case ':files'
                __fish_complete_path $word
            case ':scenarios'
                __fish_complete_suffix .yaml
                __fish_complete_suffix .yml
                __fish_complete_suffix .json
            case ':directories'
                __fish_complete_directories $word
            case ':none' ':nospace'
            case '*'
                echo $line
        end
    end
end
complete -c contactctl -f -a '(__contactctl_complete)'
