use super::*;

struct Sphere {
    name: &'static str,
    radius: f64,
    load: Option<f64>,
}

rows! { Sphere => "spheres.csv";
    "One row for each sphere.";
    sphere =>
    name["text"] = sphere.name, "Name of the sphere.";
    radius_m["m", part("radii")] = sphere.radius, "Radius.";
    load_n["N"] = sphere.load, "Load; empty where there is no contact.";
    in_contact["true/false"] = sphere.load.is_some(), "Whether there is contact.";
    letters["count"] = sphere.name.len(), "Letters of the name.";
}

#[test]
fn header_and_cells_come_from_the_columns() {
    let rows = [
        Sphere { name: "a, b", radius: 1e-6, load: Some(0.1 + 0.2) },
        Sphere { name: "c", radius: 2.0, load: None },
    ];
    let table = Table::new(rows);
    let expected =
        "name,radius_m,load_n,in_contact,letters\n\"a, b\",1e-6,0.30000000000000004,true,4\nc,2.0,,false,1\n";
    assert_eq!(String::from_utf8(table.csv().unwrap()).unwrap(), expected);
    let read = Table::read(&table.schema, expected.as_bytes()).unwrap();
    assert_eq!(read.csv().unwrap(), expected.as_bytes());
    let parted = table.without_part("radii").csv().unwrap();
    assert!(parted.starts_with(
        b"name,load_n,in_contact,letters
\"a, b\",0.3"
    ));
    let empty = Table::new::<Sphere>([]).csv().unwrap();
    assert_eq!(empty, b"name,radius_m,load_n,in_contact,letters\n");
}

#[test]
fn records_have_every_column_and_no_infinity() {
    let rows = [Sphere { name: "a", radius: f64::INFINITY, load: None }];
    let expected = serde_json::json!([
        { "name": "a", "radius_m": "inf", "load_n": null, "in_contact": false, "letters": 1 }
    ]);
    assert_eq!(Table::new(rows).records(), expected);
    assert_eq!(Value::List(vec!["a".into(), "b, c".into()]).json(), serde_json::json!(["a", "b, c"]));
}
