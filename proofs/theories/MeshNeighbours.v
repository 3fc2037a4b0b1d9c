(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* In a Delaunay triangulation, ties allowed, a nearest site is joined by an edge: a site as near as all its neighbours
   in the mesh is as near as all others. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Orientation Disc TiedRim Triangulation Inserted.
Open Scope R_scope.

(* Those of a list of which something is so. *)
Lemma sublist {A} (P : A -> Prop) (l : list A) : exists k, forall x, In x k <-> In x l /\ P x.
Proof.
  induction l as [| y l [k H]]; [exists nil; simpl; tauto |].
  destruct (classic (P y)) as [Y | Y]; [exists (y :: k) | exists k]; intros x; simpl; rewrite H; [| split].
  - split; [intros [<- | [X Q]]; auto | intros [[<- | X] Q]; auto].
  - intros [X Q]. auto.
  - intros [[<- | X] Q]; [contradiction | auto].
Qed.

Section Mesh.
Variables (N : nat) (p : nat -> point) (T : mesh).
Variable skeleton : delaunay N p (fun k => (k < N)%nat) T.
Variable distinct : forall v w, (v < N)%nat -> (w < N)%nat -> v <> w -> p v <> p w.

Lemma turned a b c : T a b c -> T b c a.
Proof. intros F. now destruct (proj1 skeleton _ _ _ F). Qed.

Lemma corner_below a b c : T a b c -> (a < N)%nat \/ a = N.
Proof. intros F. now destruct (proj1 skeleton _ _ _ F) as (_ & _ & X & _). Qed.

(* A hull edge: no site is beyond it. *)
Lemma nobody_beyond a b z : T a b N -> (a < N)%nat -> (b < N)%nat -> (z < N)%nat -> orient (p a) (p b) (p z) <= 0.
Proof.
  intros F A C Z. destruct (proj1 skeleton _ _ _ F) as (_ & _ & _ & _ & H). specialize (H z Z). unfold test in H.
  destruct (Nat.eqb_spec a N); [lia |]. destruct (Nat.eqb_spec b N); [lia |]. now rewrite Nat.eqb_refl in H.
Qed.

(* The circle of a triangle is empty. *)
Lemma mesh_circle a b c : T a b c -> (a < N)%nat -> (b < N)%nat -> (c < N)%nat ->
  0 < orient (p a) (p b) (p c) /\ exists o, about o (p a) (p b) = 0 /\ about o (p a) (p c) = 0 /\
    forall z, (z < N)%nat -> 0 <= about o (p a) (p z).
Proof.
  intros F A C D. destruct (proj1 skeleton _ _ _ F) as (_ & _ & _ & O & H). specialize (O A C D). split; [exact O |].
  destruct (centre_of (p a) (p b) (p c) O) as (o & X & Y & E). exists o. split; [exact X |]. split; [exact Y |].
  intros z Z. specialize (H z Z). unfold test in H. destruct (Nat.eqb_spec a N); [lia |].
  destruct (Nat.eqb_spec b N); [lia |]. destruct (Nat.eqb_spec c N); [lia |]. rewrite E in H.
  apply Rnot_lt_le. intros L. assert (0 < orient (p a) (p b) (p c) * - about o (p a) (p z)) by (apply
    Rmult_lt_0_compat; lra).
  lra.
Qed.

(* The triangles at a site are a fan round it, up to the hull. *)
Lemma mesh_fan a b c : T a b c -> (a < N)%nat -> (b < N)%nat -> (c < N)%nat ->
  exists faces, fan_round N p a faces /\ forall x y, In (x, y) faces -> T a x y /\ (x < N)%nat /\ (y < N)%nat.
Proof.
  intros F A C D. destruct (sublist (fun e => T a (fst e) (snd e)) (list_prod (seq 0 N) (seq 0 N))) as [faces H].
  assert (I : forall x y, In (x, y) faces <-> T a x y /\ (x < N)%nat /\ (y < N)%nat).
  { intros x y. rewrite H, in_prod_iff, !in_seq. simpl. split; [intros [[X Y] G] | intros (G & X & Y)]; repeat split;
    auto; lia. }
  exists faces. split; [| intros x y; apply I]. split.
  { intros E. assert (X : In (b, c) faces) by (apply I; auto). now rewrite E in X. }
  intros x y G. apply I in G as (G & X & Y). split; [now split |]. split; [now apply mesh_circle |].
  destruct skeleton as (_ & _ & Next & _). split.
  - destruct (Next a x y G) as [d K]. pose proof (turned _ _ _ K) as K1. pose proof (turned _ _ _ K1) as K2.
    destruct (corner_below _ _ _ K2) as [Dn | ->].
    + left. exists d. now apply I.
    + right. intros m M. pose proof (nobody_beyond x a m K X A M) as Q. unfold orient in *. lra.
  - pose proof (turned _ _ _ (turned _ _ _ G)) as G2. destruct (Next _ _ _ G2) as [d K].
    pose proof (turned _ _ _ (turned _ _ _ K)) as K2. destruct (corner_below _ _ _ K2) as [Dn | ->].
    + left. exists d. now apply I.
    + right. intros m M. pose proof (nobody_beyond a y m K A Y M) as Q. unfold orient in *. lra.
Qed.

(* In the cone of a triangle, nearer than both other corners: inside of its circle. *)
Lemma inside_circle o a b c z : 0 < orient a b c -> about o a b = 0 -> about o a c = 0 -> z <> a ->
  0 <= orient a b z -> 0 <= orient a z c -> dist a z < dist a b -> dist a z < dist a c -> about o a z < 0.
Proof.
  intros D Eb Ec Dz Zb Zc Lb Lc. set (n := orient a b c) in *. set (s := orient a z c) in *.
    set (t := orient a b z) in *.
  assert (X : n * (fst z - fst a) = s * (fst b - fst a) + t * (fst c - fst a)) by (unfold n, s, t, orient; ring).
  assert (Y : n * (snd z - snd a) = s * (snd b - snd a) + t * (snd c - snd a)) by (unfold n, s, t, orient; ring).
  pose proof (dist_pos a z (not_eq_sym Dz)) as P.
  assert (Ab : forall v, about o a v = dist2 a v - 2 * ((fst o - fst a) * (fst v - fst a) + (snd o - snd a) * (snd v -
    snd a)))
    by (intros; unfold about, dist2; ring).
  (* n |z|^2 is at most |z| (s |b| + t |c|) *)
  assert (Dot : forall v, (fst z - fst a) * (fst v - fst a) + (snd z - snd a) * (snd v - snd a) <= dist a z * dist a v).
  { intros v. apply le_of_squares; [apply Rmult_le_pos; apply dist_nonneg |].
    replace (dist a z * dist a v * (dist a z * dist a v)) with ((dist a z * dist a z) * (dist a v * dist a v)) by ring.
    rewrite !dist_sq. unfold dist2.
    pose proof (Rle_0_sqr ((fst z - fst a) * (snd v - snd a) - (snd z - snd a) * (fst v - fst a))) as Q.
      unfold Rsqr in Q. nra. }
  pose proof (Dot b) as Db. pose proof (Dot c) as Dc. rewrite Ab in Eb, Ec |- *.
  assert (Nz : n * dist2 a z = s * ((fst z - fst a) * (fst b - fst a) + (snd z - snd a) * (snd b - snd a)) +
    t * ((fst z - fst a) * (fst c - fst a) + (snd z - snd a) * (snd c - snd a))).
  { transitivity ((fst z - fst a) * (n * (fst z - fst a)) + (snd z - snd a) * (n * (snd z - snd a))); [unfold dist2;
    ring |].
    rewrite X, Y. ring. }
  assert (No : n * ((fst o - fst a) * (fst z - fst a) + (snd o - snd a) * (snd z - snd a)) =
    s * ((fst o - fst a) * (fst b - fst a) + (snd o - snd a) * (snd b - snd a)) +
    t * ((fst o - fst a) * (fst c - fst a) + (snd o - snd a) * (snd c - snd a))).
  { transitivity ((fst o - fst a) * (n * (fst z - fst a)) + (snd o - snd a) * (n * (snd z - snd a))); [ring |].
    rewrite X, Y. ring. }
  assert (Sb : dist a z * dist a b < dist2 a b) by (rewrite <- dist_sq; apply Rmult_lt_compat_r; lra).
  assert (Sc : dist a z * dist a c < dist2 a c) by (rewrite <- dist_sq; apply Rmult_lt_compat_r; lra).
  assert (Pos : 0 < s \/ 0 < t).
  { destruct (Rle_lt_or_eq_dec 0 s Zc) as [Q | Q]; [now left |]. destruct (Rle_lt_or_eq_dec 0 t Zb) as [Q' | Q'];
    [now right |].
    exfalso. rewrite <- Q, <- Q' in X, Y. apply Dz. rewrite (surjective_pairing z), (surjective_pairing a).
    f_equal; apply (Rmult_eq_reg_l n); lra. }
  set (eb := (fst z - fst a) * (fst b - fst a) + (snd z - snd a) * (snd b - snd a)) in *.
  set (ec := (fst z - fst a) * (fst c - fst a) + (snd z - snd a) * (snd c - snd a)) in *.
  set (ob := (fst o - fst a) * (fst b - fst a) + (snd o - snd a) * (snd b - snd a)) in *.
  set (oc := (fst o - fst a) * (fst c - fst a) + (snd o - snd a) * (snd c - snd a)) in *.
  set (oz := (fst o - fst a) * (fst z - fst a) + (snd o - snd a) * (snd z - snd a)) in *.
  apply (Rmult_lt_reg_l n); [exact D |]. rewrite Rmult_0_r.
  replace (n * (dist2 a z - 2 * oz)) with (n * dist2 a z - 2 * (n * oz)) by ring. rewrite Nz, No.
  assert (Wb : eb < 2 * ob) by lra. assert (Wc : ec < 2 * oc) by lra.
  assert (s * eb <= s * (2 * ob)) by (apply Rmult_le_compat_l; lra).
  assert (t * ec <= t * (2 * oc)) by (apply Rmult_le_compat_l; lra).
  destruct Pos as [Q | Q].
  - assert (s * eb < s * (2 * ob)) by (apply Rmult_lt_compat_l; lra). lra.
  - assert (t * ec < t * (2 * oc)) by (apply Rmult_lt_compat_l; lra). lra.
Qed.

(* s is joined to a in the mesh. *)
Definition next_to (a s : nat) : Prop := (s < N)%nat /\ exists c, T a s c.

(* The triangle at a site towards another one. *)
Lemma triangle_towards a b c k : T a b c -> (a < N)%nat -> (b < N)%nat -> (c < N)%nat -> (k < N)%nat -> k <> a ->
  exists x y o, next_to a x /\ next_to a y /\
  0 < orient (p a) (p x) (p y) /\ about o (p a) (p x) = 0 /\ about o (p a) (p y) = 0 /\ 0 <= about o (p a) (p k) /\
  0 <= orient (p a) (p x) (p k) /\ 0 <= orient (p a) (p k) (p y).
Proof.
  intros F A C D K Dk. destruct (mesh_fan a b c F A C D) as (faces & Fan & Real).
  destruct (sites_covered N p a faces Fan k A K (distinct k a K A Dk)) as (x & y & G & Ox & Oy).
  destruct (Real x y G) as (Q & X & Y). destruct (mesh_circle a x y Q A X Y) as (O & o & Ex & Ey & Out).
  exists x, y, o. split; [split; [exact X | now exists y] |]. split.
  { split; [exact Y |]. destruct skeleton as (_ & _ & Next & _).
    destruct (Next _ _ _ (turned _ _ _ (turned _ _ _ Q))) as [d H]. now exists d. }
  now repeat split; try apply Out.
Qed.

Theorem nearest_beside a b c k : T a b c -> (a < N)%nat -> (b < N)%nat -> (c < N)%nat -> (k < N)%nat -> k <> a ->
  exists s, next_to a s /\ dist (p a) (p s) <= dist (p a) (p k).
Proof.
  intros F A C D K Dk.
  destruct (triangle_towards a b c k F A C D K Dk) as (x & y & o & X & Y & O & Ex & Ey & Ek & Ox & Oy).
  destruct (Rle_dec (dist (p a) (p x)) (dist (p a) (p k))) as [L | L]; [now exists x |].
  destruct (Rle_dec (dist (p a) (p y)) (dist (p a) (p k))) as [M | M]; [now exists y |]. exfalso.
  pose proof (inside_circle o (p a) (p x) (p y) (p k) O Ex Ey (distinct k a K A Dk) Ox Oy ltac:(lra) ltac:(lra)). lra.
Qed.

(* The requirement on c along the way from a: dist2 c z - dist2 c a, in coordinates from a. *)
Lemma nearer_in_cone o a b c z w : 0 < orient a b c -> about o a b = 0 -> about o a c = 0 -> 0 <= about o a z ->
  0 <= orient a b z -> 0 <= orient a z c -> dist2 w a <= dist2 w b -> dist2 w a <= dist2 w c -> dist2 w a <= dist2 w z.
Proof.
  intros D Eb Ec Ez Zb Zc Lb Lc. set (n := orient a b c) in *. set (s := orient a z c) in *.
    set (t := orient a b z) in *.
  assert (E : n * (dist2 w z - dist2 w a - about o a z) =
    s * (dist2 w b - dist2 w a - about o a b) + t * (dist2 w c - dist2 w a - about o a c))
    by (unfold n, s, t, orient, about, dist2; ring).
  rewrite Eb, Ec in E. assert (0 <= s * (dist2 w b - dist2 w a - 0)) by (apply Rmult_le_pos; lra).
  assert (0 <= t * (dist2 w c - dist2 w a - 0)) by (apply Rmult_le_pos; lra).
  assert (0 <= dist2 w z - dist2 w a - about o a z) by (apply (Rmult_le_reg_l n); lra). lra.
Qed.

Variable everybody : forall a, (a < N)%nat -> exists b c, T a b c /\ (b < N)%nat /\ (c < N)%nat.

(* If a site is nearer to w than a, a neighbour of a is. *)
Theorem greedy a k w : (a < N)%nat -> (k < N)%nat -> dist w (p k) < dist w (p a) ->
  exists s, next_to a s /\ dist w (p s) < dist w (p a).
Proof.
  intros A K L. assert (Dk : k <> a) by (intros ->; lra). destruct (everybody a A) as (b & e & F & C & D).
  destruct (triangle_towards a b e k F A C D K Dk) as (x & y & o & X & Y & O & Ex & Ey & Ek & Ox & Oy).
  destruct (Rlt_dec (dist w (p x)) (dist w (p a))) as [Lx | Lx]; [now exists x |].
  destruct (Rlt_dec (dist w (p y)) (dist w (p a))) as [Ly | Ly]; [now exists y |]. exfalso.
  apply Rnot_lt_le, dist_le in Lx. apply Rnot_lt_le, dist_le in Ly. apply dist_lt in L.
  pose proof (nearer_in_cone o (p a) (p x) (p y) (p k) w O Ex Ey Ek Ox Oy Lx Ly). lra.
Qed.

Lemma next_sym a s : (a < N)%nat -> next_to a s -> next_to s a.
Proof.
  intros A [S [c F]]. split; [exact A |]. destruct skeleton as (_ & _ & Next & _). destruct (Next _ _ _ F) as [d G].
    now exists d.
Qed.

(* If no neighbour of i or j is in a disc that holds the two, no other site is: the sites in a disc are connected. *)
Theorem disc_connected i j c r : (i < N)%nat -> (j < N)%nat -> dist c (p i) <= r -> dist c (p j) <= r ->
  (forall s, next_to i s \/ next_to j s -> s <> i -> s <> j -> r < dist c (p s)) ->
  forall k, (k < N)%nat -> k <> i -> k <> j -> r < dist c (p k).
Proof.
  intros I J Ri Rj Off k0 K0 Di0 Dj0. apply Rnot_le_lt. intros R0.
  (* i or j is nearest to c *)
  assert (Near : exists a, (a = i \/ a = j) /\ forall w, (w < N)%nat -> dist c (p a) <= dist c (p w)).
  { destruct (finite_min (fun _ => True) (fun k => dist c (p k)) N) as (m & M & _ & Least); [now exists i |].
    assert (Least' : forall w, (w < N)%nat -> dist c (p m) <= dist c (p w)) by (intros w W; now apply Least).
    destruct (Rle_dec (dist c (p i)) (dist c (p m))) as [Li | Li].
    { exists i. split; [now left |]. intros w W. specialize (Least' w W). lra. }
    destruct (Rle_dec (dist c (p j)) (dist c (p m))) as [Lj | Lj].
    { exists j. split; [now right |]. intros w W. specialize (Least' w W). lra. }
    exfalso. destruct (greedy i m c I M ltac:(lra)) as (s & S & Ls). destruct (greedy j m c J M ltac:(lra)) as (t & U
      & Lt).
    destruct (Nat.eq_dec s i) as [-> | Si]; [lra |]. destruct (Nat.eq_dec s j) as [-> | Sj].
    - destruct (Nat.eq_dec t j) as [-> | Tj]; [lra |]. destruct (Nat.eq_dec t i) as [-> | Ti]; [lra |].
      specialize (Off t (or_intror U) Ti Tj). lra.
    - specialize (Off s (or_introl S) Si Sj). lra. }
  destruct Near as (a & Ha & Least). assert (A : (a < N)%nat) by (destruct Ha as [-> | ->]; assumption).
  set (d := dist c (p a)) in *. assert (D0 : 0 <= d) by apply dist_nonneg.
  (* a little nearer to a, no other site ties with a *)
  destruct (small_finite (fun w e => r < dist c (p w) -> r + 2 * e < dist c (p w)) N) as (e & E0 & Room).
  { intros w _. destruct (Rlt_dec r (dist c (p w))) as [L | L]; [| exists 1; split; [lra |]; intros; lra].
    exists ((dist c (p w) - r) / 3). split; [lra |]. intros; lra. }
  set (t := Rmin (1 / 2) (e / (d + 1))).
  assert (Pt : 0 < t <= 1 / 2).
  { split; [apply Rmin_pos; [lra | apply Rdiv_lt_0_compat; lra] | apply Rmin_l]. }
  assert (Td : t * d <= e).
  { assert (t <= e / (d + 1)) by apply Rmin_r. assert (e / (d + 1) * (d + 1) = e) by (field; lra).
    assert (t * (d + 1) <= e / (d + 1) * (d + 1)) by (apply Rmult_le_compat_r; lra). lra. }
  set (w := mix t c (p a)). assert (Cw : dist c w = t * d) by (unfold w; apply dist_mix_left; lra).
  assert (Only : forall k, (k < N)%nat -> k <> a -> dist w (p a) < dist w (p k)).
  { intros k K Dk. apply dist_lt. pose proof (Least k K) as L.
    assert (X : dist2 c (p a) <= dist2 c (p k)) by (apply dist_le; exact L).
    assert (Y : 0 < dist2 (p a) (p k)).
    { pose proof (dist_pos (p a) (p k) (distinct a k A K (not_eq_sym Dk))). rewrite <- dist_sq. nra. }
    assert (W : dist2 w (p k) - dist2 w (p a) = (1 - t) * (dist2 c (p k) - dist2 c (p a)) + t * dist2 (p a) (p k))
      by (unfold w, dist2, mix; simpl; ring).
    assert (0 <= (1 - t) * (dist2 c (p k) - dist2 c (p a))) by (apply Rmult_le_pos; lra).
    assert (0 < t * dist2 (p a) (p k)) by (apply Rmult_lt_0_compat; lra). lra. }
  destruct (finite_min (fun k => k <> i /\ k <> j /\ dist c (p k) <= r) (fun k => dist w (p k)) N)
    as (k & K & (Di & Dj & Rk) & First); [exists k0; tauto |].
  assert (Dk : k <> a) by (destruct Ha as [-> | ->]; assumption).
  destruct (greedy k a w K A (Only k K Dk)) as (s & S & Ls).
  assert (Rs : dist c (p s) <= r).
  { apply Rnot_lt_le. intros L. pose proof (Room e (conj E0 (Rle_refl e)) s (proj1 S) L).
    pose proof (dist_triangle c w (p s)). pose proof (dist_triangle w c (p k)) as X. rewrite (dist_sym w c) in X. lra. }
  assert (In' : s = i \/ s = j).
  { destruct (Nat.eq_dec s i) as [Q | Si]; [now left |]. destruct (Nat.eq_dec s j) as [Q | Sj]; [now right |]. exfalso.
    pose proof (First s (proj1 S) (conj Si (conj Sj Rs))). lra. }
  assert (Next : next_to i k \/ next_to j k) by (destruct In' as [<- | <-]; [left | right]; now apply next_sym).
  specialize (Off k Next Di Dj). lra.
Qed.

(* Beyond the side of its triangle, a site is lower than a by as much as the corners are. *)
Theorem lower_than_neighbours a u m : (a < N)%nat -> 0 <= m ->
  (forall s, next_to a s -> m < dot u (p a) - dot u (p s)) ->
  forall k, (k < N)%nat -> k <> a -> m < dot u (p a) - dot u (p k).
Proof.
  intros A M H k K Dk. destruct (everybody a A) as (b & e & F & C & D).
  destruct (triangle_towards a b e k F A C D K Dk) as (x & y & o & X & Y & O & Ex & Ey & Ek & Ox & Oy).
  pose proof (H x X) as Hx. pose proof (H y Y) as Hy. set (n := orient (p a) (p x) (p y)) in *.
  set (s := orient (p a) (p k) (p y)) in *. set (t := orient (p a) (p x) (p k)) in *.
  assert (E : n * (dot u (p a) - dot u (p k)) = s * (dot u (p a) - dot u (p x)) + t * (dot u (p a) - dot u (p y)))
    by (unfold n, s, t, orient, dot; ring).
  assert (Pow : n * (dist2 (p a) (p k) - about o (p a) (p k)) = s * (dist2 (p a) (p x) - about o (p a) (p x)) +
    t * (dist2 (p a) (p y) - about o (p a) (p y))) by (unfold n, s, t, orient, about, dist2; ring).
  rewrite Ex, Ey in Pow.
  assert (Sq : n * n * dist2 (p a) (p k) = (s + t) * (s * dist2 (p a) (p x) + t * dist2 (p a) (p y)) - s * t * dist2
    (p x) (p y))
    by (unfold n, s, t, orient, dist2; ring).
  pose proof (dist2_nonneg (p x) (p y)) as Dxy.
  assert (Dak : 0 < dist2 (p a) (p k)).
  { pose proof (dist_pos (p a) (p k) (distinct a k A K (not_eq_sym Dk))). rewrite <- dist_sq. nra. }
  assert (Q : n * dist2 (p a) (p k) >= s * dist2 (p a) (p x) + t * dist2 (p a) (p y)).
  { assert (0 <= n * about o (p a) (p k)) by (apply Rmult_le_pos; lra). lra. }
  (* so the weights sum up to 1 at least *)
  assert (Sum : n <= s + t).
  { apply Rnot_lt_le. intros L. assert (0 <= s * t * dist2 (p x) (p y)) by (apply Rmult_le_pos;
    [apply Rmult_le_pos |]; lra).
    assert (0 < n * dist2 (p a) (p k)) by (apply Rmult_lt_0_compat; lra).
    assert ((s + t) * (s * dist2 (p a) (p x) + t * dist2 (p a) (p y)) <= (s + t) * (n * dist2 (p a) (p k)))
      by (apply Rmult_le_compat_l; lra).
    assert ((s + t) * (n * dist2 (p a) (p k)) < n * (n * dist2 (p a) (p k))) by (apply Rmult_lt_compat_r; lra). lra. }
  apply (Rmult_lt_reg_l n); [exact O |]. rewrite E.
  assert (n * m <= (s + t) * m) by (apply Rmult_le_compat_r; lra).
  assert (s * m <= s * (dot u (p a) - dot u (p x))) by (apply Rmult_le_compat_l; lra).
  assert (t * m <= t * (dot u (p a) - dot u (p y))) by (apply Rmult_le_compat_l; lra).
  destruct (Rle_lt_or_eq_dec 0 s Oy) as [S | S].
  - assert (s * m < s * (dot u (p a) - dot u (p x))) by (apply Rmult_lt_compat_l; lra). lra.
  - assert (0 < t) by lra. assert (t * m < t * (dot u (p a) - dot u (p y))) by (apply Rmult_lt_compat_l; lra). lra.
Qed.
End Mesh.
