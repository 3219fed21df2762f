use egg::diagnostics::render::{Source, Sources, Style, human};
use egg::project::{Notation, load};
#[test]
fn scratch() {
    for f in std::fs::read_dir("tests/corpus/projects/wrong").unwrap() {
        let p = f.unwrap().path();
        let text = std::fs::read_to_string(&p).unwrap();
        let n = Notation::of_extension(p.extension().unwrap().to_str().unwrap()).unwrap();
        let l = load(&text, n, "x");
        println!("######## {} {}", p.display(), l.project.is_some());
        let name = p.display().to_string();
        let s = Sources {
            project: Source {
                name: &name,
                text: &text,
            },
            spans: &l.spans,
            mesh: None,
        };
        println!("{}", human(&l.diagnostics, &s, Style::Plain));
    }
}
