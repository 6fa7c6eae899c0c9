"""Sources that `convert` refuses in a page, as expressions of JavaScript, with its messages as patterns."""

BAD = {
    "''": 'the source "" is no address; give an SVG or GeoJSON',
    "' '": 'the source " " is no address; give an SVG or GeoJSON',
    "'http://'": 'the source "http://" is no address',
    "'PNG'": '/usual/PNG" answers 404; check the address',
    "'none.svg'": "answers 404; check the address",
    "'http://127.0.0.1:9/a.svg'": '"http://127.0.0.1:9/a.svg" cannot be loaded',
    "new Blob(['PNG'])": 'the source is a text that begins with "PNG"; give SVG, GeoJSON or TopoJSON',
    "new File([new Uint8Array([137, 80, 78, 71, 13, 10, 26, 10, 0])], 'a.png')": (
        '"a.png" is a PNG picture that is damaged; save it again'
    ),
    "new File(['Dear all'], 'a.txt')": '"a.txt" is a text that begins with "Dear all"; give SVG, GeoJSON or TopoJSON',
    "new File([new Uint8Array([255, 216, 255, 224, 0, 16, 74, 70, 73, 70, 0])], 'a')": '"a" is a JPEG picture',
    "new File([new Uint8Array([7, 200, 1])], 'a')": '"a" is no text; it begins with ',
    "new File(['%PDF-1.4'], 'a.svg')": '"a.svg" is a PDF document',
    "new Blob([])": "the source is empty; give SVG, GeoJSON or TopoJSON",
    "new Blob([new Uint8Array([31, 139, 8, 0, 1, 2, 3])])": "the file cannot be read",
    "new Blob([new Uint8Array(5e7)])": "the file is larger than 33,554,432 bytes; simplify or split the drawing",
    "'<svg xmlns=\"http://www.w3.org/2000/svg\">' + ' '.repeat(5e7)": "33,554,432",
    "'{' + ' '.repeat(5e7)": "the text has 50,000,001 letters; a page reads 33,554,432; simplify or split it",
    '`{"type":"Polygon","coordinates":${\'[\'.repeat(1e5)}${\']\'.repeat(1e5)}}`': "its lists are nested too deeply",
    '`${\'{"type":"GeometryCollection","geometries":[\'.repeat(1e5)}${\']}\'.repeat(1e5)}`': "more than 32 deep",
    "'<svg xmlns=\"http://www.w3.org/2000/svg\"><path'": "not well-formed XML",
    "'<!doctype html><html><p>text</html>'": "not well-formed XML|not <svg>",
    "'<html xmlns=\"http://www.w3.org/1999/xhtml\"><body/></html>'": "the root element is <html>, not <svg>",
    "'{'": "JSON",
    "'{}'": "type",
    "document.body": "give an <svg> of the page",
    "null": "the source is null; give an SVG or GeoJSON",
    "5": "the source is 5; give an SVG or GeoJSON",
    "undefined": "the source is undefined; give an SVG or GeoJSON",
}
