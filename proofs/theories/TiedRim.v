(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The rim of a face of exact points [TIE-2]: certain edges all round keep every other point out of the circles of its
   triangles and from beyond its hull edges, for every choice. A point that moves from its place in the skeleton to
   another of its rectangle would have to enter through an edge of the rim. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Distance Cells Legal Orientation Disc Path Fan TiedFace.
Open Scope R_scope.

(* ---- circles through two points ---- *)

(* The power of z about the circle with centre o through a. *)
Definition about (o a z : point) : R := dist2 o z - dist2 o a.

(* Two circles through a and b: their powers differ by a multiple of the distance from the line ab. *)
Lemma pencil o w a b : a <> b -> about o a b = 0 -> about w a b = 0 ->
  exists l, forall z, about w a z = about o a z + l * orient a b z.
Proof.
  intros D O W. assert (S : 0 < dist2 a b) by (rewrite <- dist_sq; pose proof (dist_pos a b D); nra).
  set (n := (fst b - fst a) * (snd w - snd o) - (snd b - snd a) * (fst w - fst o)).
  exists (-2 * n / dist2 a b). intros z. apply (Rmult_eq_reg_l (dist2 a b)); [| lra].
  replace (dist2 a b * (about o a z + -2 * n / dist2 a b * orient a b z))
    with (dist2 a b * about o a z - 2 * n * orient a b z) by (field; lra).
  assert (K : about w a b - about o a b = 0) by lra.
  apply Rminus_diag_uniq. transitivity ((about w a b - about o a b) *
    ((fst b - fst a) * (fst z - fst a) + (snd b - snd a) * (snd z - snd a)));
    [unfold about, dist2, orient, n; simpl; ring | rewrite K; ring].
Qed.

(* In the coordinates of a triangle: its circle. *)
Lemma about_barycentric o a b c z : about o a b = 0 -> about o a c = 0 ->
  orient a b c * orient a b c * about o a z =
  - (orient b c z * orient c a z * dist2 a b + orient c a z * orient a b z * dist2 b c +
     orient a b z * orient b c z * dist2 c a).
Proof.
  intros Eb Ec.
  assert (E : orient a b c * orient a b c * about o a z +
    (orient b c z * orient c a z * dist2 a b + orient c a z * orient a b z * dist2 b c +
     orient a b z * orient b c z * dist2 c a) =
    orient a b c * (orient c a z * about o a b + orient a b z * about o a c))
    by (unfold about, dist2, orient; simpl; ring).
  rewrite Eb, Ec in E. lra.
Qed.

Lemma orient_sum a b c z : orient b c z + orient c a z + orient a b z = orient a b c.
Proof. unfold orient. ring. Qed.

(* A point beyond one side of a triangle, and not outside of its circle, is on the inner side of the others. *)
Lemma cap o a b c z : about o a b = 0 -> about o a c = 0 -> 0 < orient a b c -> orient a b z < 0 -> about o a z <= 0 ->
  0 < orient b c z /\ 0 < orient c a z.
Proof.
  intros Eb Ec D Z P. pose proof (about_barycentric o a b c z Eb Ec) as E. pose proof (orient_sum a b c z) as S.
  set (x := orient b c z) in *. set (y := orient c a z) in *. set (t := orient a b z) in *.
    set (d := orient a b c) in *.
  assert (Q : 0 <= x * y * dist2 a b + y * t * dist2 b c + t * x * dist2 c a).
  { assert (0 <= d * d * - about o a z) by (apply Rmult_le_pos; nra). lra. }
  assert (Pos : forall u v, u <> v -> 0 < dist2 u v)
    by (intros u v H; rewrite <- dist_sq; pose proof (dist_pos u v H); nra).
  assert (Dca : c <> a) by (intros F; unfold d, orient in D; rewrite F in D; lra).
  assert (Dbc : b <> c) by (intros F; unfold d, orient in D; rewrite F in D; lra).
  pose proof (Pos c a Dca) as Bca. pose proof (Pos b c Dbc) as Bbc. pose proof (dist2_nonneg a b) as Bab.
  split; apply Rnot_le_lt; intros L.
  - (* x <= 0: y = d - x - t *)
    set (q := - t) in *. set (p := - x) in *.
    assert (Sq : 0 <= p * p * dist2 a b + q * q * dist2 b c + p * q * (dist2 a b + dist2 b c - dist2 c a)).
    { replace (p * p * dist2 a b + q * q * dist2 b c + p * q * (dist2 a b + dist2 b c - dist2 c a)) with
        ((p * (fst a - fst b) + q * (fst c - fst b)) * (p * (fst a - fst b) + q * (fst c - fst b)) +
         (p * (snd a - snd b) + q * (snd c - snd b)) * (p * (snd a - snd b) + q * (snd c - snd b)))
        by (unfold dist2; ring).
      apply Rplus_le_le_0_compat; apply Rle_0_sqr. }
    assert (Y : y = d + p + q) by (unfold p, q; lra).
    assert (F : x * y * dist2 a b + y * t * dist2 b c + t * x * dist2 c a =
      - (p * p * dist2 a b + q * q * dist2 b c + p * q * (dist2 a b + dist2 b c - dist2 c a)) -
      d * (p * dist2 a b + q * dist2 b c)) by (rewrite Y; unfold p, q; ring).
    assert (0 < q * dist2 b c) by (apply Rmult_lt_0_compat; unfold q; lra).
    assert (0 <= p * dist2 a b) by (apply Rmult_le_pos; unfold p; lra).
    assert (0 < d * (p * dist2 a b + q * dist2 b c)) by (apply Rmult_lt_0_compat; lra). lra.
  - set (q := - t) in *. set (p := - y) in *.
    assert (Sq : 0 <= p * p * dist2 a b + q * q * dist2 c a + p * q * (dist2 a b + dist2 c a - dist2 b c)).
    { replace (p * p * dist2 a b + q * q * dist2 c a + p * q * (dist2 a b + dist2 c a - dist2 b c)) with
        ((p * (fst b - fst a) + q * (fst c - fst a)) * (p * (fst b - fst a) + q * (fst c - fst a)) +
         (p * (snd b - snd a) + q * (snd c - snd a)) * (p * (snd b - snd a) + q * (snd c - snd a)))
        by (unfold dist2; ring).
      apply Rplus_le_le_0_compat; apply Rle_0_sqr. }
    assert (X : x = d + p + q) by (unfold p, q; lra).
    assert (F : x * y * dist2 a b + y * t * dist2 b c + t * x * dist2 c a =
      - (p * p * dist2 a b + q * q * dist2 c a + p * q * (dist2 a b + dist2 c a - dist2 b c)) -
      d * (p * dist2 a b + q * dist2 c a)) by (rewrite X; unfold p, q; ring).
    assert (0 < q * dist2 c a) by (apply Rmult_lt_0_compat; unfold q; lra).
    assert (0 <= p * dist2 a b) by (apply Rmult_le_pos; unfold p; lra).
    assert (0 < d * (p * dist2 a b + q * dist2 c a)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Lemma in_triangle o a b c z : about o a b = 0 -> about o a c = 0 -> 0 < orient a b c ->
  0 <= orient b c z -> 0 <= orient c a z -> 0 <= orient a b z -> z <> a -> z <> b -> z <> c -> about o a z < 0.
Proof.
  intros Eb Ec D X Y T Na Nb Nc. pose proof (about_barycentric o a b c z Eb Ec) as E.
  pose proof (orient_sum a b c z) as S.
  assert (Hx : orient a b c * fst z = orient b c z * fst a + orient c a z * fst b + orient a b z * fst c)
    by (unfold orient; ring).
  assert (Hy : orient a b c * snd z = orient b c z * snd a + orient c a z * snd b + orient a b z * snd c)
    by (unfold orient; ring).
  assert (Pos : forall u v, u <> v -> 0 < dist2 u v)
    by (intros u v H; rewrite <- dist_sq; pose proof (dist_pos u v H); nra).
  assert (Dab : 0 < dist2 a b) by (apply Pos; intros F; unfold orient in D; rewrite F in D; lra).
  assert (Dbc : 0 < dist2 b c) by (apply Pos; intros F; unfold orient in D; rewrite F in D; lra).
  assert (Dca : 0 < dist2 c a) by (apply Pos; intros F; unfold orient in D; rewrite F in D; lra).
  set (x := orient b c z) in *. set (y := orient c a z) in *. set (t := orient a b z) in *.
    set (d := orient a b c) in *.
  assert (G : 0 < x * y * dist2 a b + y * t * dist2 b c + t * x * dist2 c a).
  { assert (Gxy : 0 <= x * y * dist2 a b) by (apply Rmult_le_pos; [now apply Rmult_le_pos | lra]).
    assert (Gyt : 0 <= y * t * dist2 b c) by (apply Rmult_le_pos; [now apply Rmult_le_pos | lra]).
    assert (Gtx : 0 <= t * x * dist2 c a) by (apply Rmult_le_pos; [now apply Rmult_le_pos | lra]).
    destruct (Req_dec x 0) as [Zx | Zx]; destruct (Req_dec y 0) as [Zy | Zy]; destruct (Req_dec t 0) as [Zt | Zt].
    - lra.
    - exfalso. apply Nc. apply (scaled_point_eq d); [lra | |]; [rewrite Hx | rewrite Hy]; rewrite Zx, Zy;
        replace t with d by lra; ring.
    - exfalso. apply Nb. apply (scaled_point_eq d); [lra | |]; [rewrite Hx | rewrite Hy]; rewrite Zx, Zt;
        replace y with d by lra; ring.
    - assert (0 < y * t * dist2 b c) by (apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat |]; lra). lra.
    - exfalso. apply Na. apply (scaled_point_eq d); [lra | |]; [rewrite Hx | rewrite Hy]; rewrite Zy, Zt;
        replace x with d by lra; ring.
    - assert (0 < t * x * dist2 c a) by (apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat |]; lra). lra.
    - assert (0 < x * y * dist2 a b) by (apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat |]; lra). lra.
    - assert (0 < x * y * dist2 a b) by (apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat |]; lra). lra. }
  assert (0 < d * d) by (now apply Rmult_lt_0_compat).
  apply (Rmult_lt_reg_l (d * d)); [assumption |]. lra.
Qed.

(* ---- finite lists ---- *)

Lemma least {A} (f : A -> R) (P : A -> Prop) l : (exists x, In x l /\ P x) ->
  exists x, In x l /\ P x /\ forall y, In y l -> P y -> f x <= f y.
Proof.
  induction l as [| a l IH]; intros [x [X Px]]; [destruct X |].
  destruct (classic (exists y, In y l /\ P y)) as [E | E].
  - destruct (IH E) as [m [M [Pm L]]]. destruct (classic (P a /\ f a <= f m)) as [[Pa La] | C].
    + exists a. split; [now left |]. split; [exact Pa |]. intros y [<- | Y] Py; [lra |]. specialize (L y Y Py). lra.
    + exists m. split; [now right |]. split; [exact Pm |]. intros y [<- | Y] Py; [| now apply L].
      apply Rnot_lt_le. intros K. apply C. split; [exact Py | lra].
  - exists x. split; [exact X |]. split; [exact Px |]. intros y Y Py.
    destruct X as [-> | X]; [| exfalso; apply E; now exists x].
    destruct Y as [-> | Y]; [lra | exfalso; apply E; now exists y].
Qed.

Lemma fewer (f g : nat -> bool) l x : (forall y, g y = true -> f y = true) ->
  In x l -> f x = true -> g x = false -> (length (filter g l) < length (filter f l))%nat.
Proof.
  intros I X F G. assert (Le : forall k, (length (filter g k) <= length (filter f k))%nat).
  { induction k as [| y k IH]; simpl; [lia |]. destruct (g y) eqn:Gy; [rewrite (I y Gy); simpl; lia |].
    destruct (f y); simpl; lia. }
  induction l as [| y l IH]; [destruct X |]. destruct X as [-> | X].
  - simpl. rewrite F, G. simpl. specialize (Le l). lia.
  - specialize (IH X). simpl. destruct (g y) eqn:Gy; [rewrite (I y Gy); simpl; lia |]. destruct (f y); simpl; lia.
Qed.

(* ---- faces ---- *)

(* A triangle from one of its corners, counterclockwise, with the centre of its circle. *)
Record triangle : Type := Tri { ta : nat; tb : nat; tc : nat; centre : point }.

(* ---- the way to a point in the disc of a triangle ---- *)

Section Walk.
Variables (p : nat -> point) (T : list triangle) (z : point) (Out : nat -> nat -> Prop).
Variable turned : forall a b c o, In (Tri a b c o) T -> In (Tri b c a o) T /\
  about o (p a) (p b) = 0 /\ about o (p a) (p c) = 0 /\ 0 < orient (p a) (p b) (p c).
(* Beyond a side there is a triangle whose corner is not in this one's disc, or it is a way out. *)
Variable next : forall a b c o, In (Tri a b c o) T -> about o (p a) z < 0 -> orient (p a) (p b) z < 0 ->
  (exists l w, In (Tri b a l w) T /\ 0 <= about o (p a) (p l)) \/ Out a b.

Definition within (t : triangle) : Prop :=
  0 <= orient (p (ta t)) (p (tb t)) z /\ 0 <= orient (p (tb t)) (p (tc t)) z /\ 0 <= orient (p (tc t)) (p (ta t)) z.

Lemma walk_from M : M < 0 -> (forall t, In t T -> M <= about (centre t) (p (ta t)) z) ->
  forall n a b c o, In (Tri a b c o) T -> about o (p a) z = M -> orient (p a) (p b) z < 0 ->
  (length (filter (fun x => if Rlt_dec (orient (p a) (p b) (p x)) 0 then
    if Rle_dec (about o (p a) (p x)) 0 then true else false else false) (map ta T)) < n)%nat ->
  (exists t, In t T /\ about (centre t) (p (ta t)) z = M /\ within t) \/ exists a b, Out a b.
Proof.
  intros M0 Least. induction n as [| n IH]; intros a b c o F E Z Few; [lia |].
  destruct (turned _ _ _ _ F) as [_ [Eb [Ec D]]].
  assert (Dab : p a <> p b) by (intros X; unfold orient in D; rewrite X in D; lra).
  destruct (next _ _ _ _ F) as [[l [w [G Empty]]] | S]; [now rewrite E | exact Z | |].
  - destruct (turned _ _ _ _ G) as [G1 [Wa [Wl D']]]. destruct (turned _ _ _ _ G1) as [G2 _].
    assert (Wb : about w (p a) (p b) = 0) by (unfold about in *; lra).
    assert (Wl' : about w (p a) (p l) = 0) by (unfold about in *; lra).
    destruct (pencil o w (p a) (p b) Dab Eb Wb) as [k K].
    assert (Dl : orient (p a) (p b) (p l) < 0) by (unfold orient in *; lra).
    assert (K0 : 0 <= k).
    { pose proof (K (p l)) as X. rewrite Wl' in X. pose proof Empty as Y.
      apply Rnot_lt_le. intros C. assert (0 < k * orient (p a) (p b) (p l)) by nra. lra. }
    assert (Kz : k = 0).
    { pose proof (K z) as X. pose proof (Least _ G) as Y. simpl in Y.
      assert (about w (p b) z = about w (p a) z) as Q by (unfold about in *; lra). rewrite Q, X, E in Y.
      apply Rle_antisym; [| exact K0]. apply Rnot_lt_le. intros C.
      assert (k * orient (p a) (p b) z < 0) by nra. lra. }
    assert (Same : forall x, about w (p a) x = about o (p a) x) by (intros x; rewrite K, Kz; ring).
    assert (Same_l : forall x, about w (p l) x = about o (p a) x) by (intros x; rewrite <- Same; unfold about in *;
      lra).
    assert (At_l : In l (map ta T)) by (change l with (ta (Tri l b a w)); now apply in_map).
    assert (Inner : forall x, about o (p a) x <= 0 ->
      orient (p a) (p l) x < 0 \/ orient (p l) (p b) x < 0 -> orient (p a) (p b) x < 0).
    { intros x X [Y | Y].
      - assert (C : 0 < orient (p b) (p a) x); [| unfold orient in *; lra].
        apply (cap w (p a) (p l) (p b) x); rewrite ?Same; try assumption; try (now rewrite <- Same).
        unfold orient in *. lra.
      - assert (C : 0 < orient (p b) (p a) x); [| unfold orient in *; lra].
        apply (cap w (p l) (p b) (p a) x); rewrite ?Same_l; try assumption; try (unfold about, orient in *; lra). }
    assert (Fewer : forall u v, (forall x, about o (p a) x <= 0 -> orient (p u) (p v) x < 0 ->
      orient (p a) (p b) x < 0) ->
      orient (p u) (p v) (p l) = 0 -> (forall x, about w (p u) x = about o (p a) x) ->
      (length (filter (fun x => if Rlt_dec (orient (p u) (p v) (p x)) 0 then
        if Rle_dec (about w (p u) (p x)) 0 then true else false else false) (map ta T)) < n)%nat).
    { intros u v I Zl Su. eapply Nat.lt_le_trans; [| apply Nat.lt_succ_r; exact Few].
      apply fewer with (x := l); [| exact At_l | |].
      - intros y. rewrite Su. destruct (Rlt_dec (orient (p u) (p v) (p y)) 0) as [Y | Y]; [| discriminate].
        destruct (Rle_dec (about o (p a) (p y)) 0) as [X | X]; [| discriminate].
        destruct (Rlt_dec (orient (p a) (p b) (p y)) 0) as [_ | C]; [reflexivity | exfalso; now apply C, I].
      - destruct (Rlt_dec (orient (p a) (p b) (p l)) 0) as [_ | C]; [| contradiction].
        destruct (Rle_dec (about o (p a) (p l)) 0) as [_ | C]; [reflexivity | exfalso; apply C; rewrite <- Same; lra].
      - rewrite Zl. destruct (Rlt_dec 0 0) as [C | _]; [lra | reflexivity]. }
    destruct (Rlt_dec (orient (p a) (p l) z) 0) as [Y | Y];
      [| destruct (Rlt_dec (orient (p l) (p b) z) 0) as [X | X]].
    + apply (IH a l b w); [exact G1 | now rewrite Same | exact Y |]. apply Fewer.
      * intros x P Q. apply Inner; [exact P | now left].
      * unfold orient. ring.
      * exact Same.
    + apply (IH l b a w); [exact G2 | now rewrite Same_l | exact X |]. apply Fewer.
      * intros x P Q. apply Inner; [exact P | now right].
      * unfold orient. ring.
      * exact Same_l.
    + left. exists (Tri b a l w). split; [exact G |]. unfold within. simpl.
      split; [rewrite <- E, <- Same; unfold about in *; lra |].
      repeat split; [unfold orient in *; lra | lra | lra].
  - right. now exists a, b.
Qed.

(* In the disc of a triangle: in a triangle, and inside of its disc, too, or past a way out. *)
Lemma walk : (exists t, In t T /\ about (centre t) (p (ta t)) z < 0) ->
  (exists t, In t T /\ about (centre t) (p (ta t)) z < 0 /\ within t) \/ exists a b, Out a b.
Proof.
  intros [t [F L]].
  destruct (least (fun t => about (centre t) (p (ta t)) z) (fun _ => True) T) as [[a b c o] [G [_ M']]];
    [now exists t |].
  assert (M : forall f, In f T -> about o (p a) z <= about (centre f) (p (ta f)) z) by (intros f K; now apply M').
  assert (M0 : about o (p a) z < 0) by (specialize (M t F); lra).
  assert (Found : (exists t, In t T /\ about (centre t) (p (ta t)) z = about o (p a) z /\ within t) \/
    exists a b, Out a b).
  { destruct (turned _ _ _ _ G) as [G1 [Eb [Ec D]]]. destruct (turned _ _ _ _ G1) as [G2 _].
    destruct (Rlt_dec (orient (p a) (p b) z) 0) as [X | X]; [| destruct (Rlt_dec (orient (p b) (p c) z) 0) as [Y | Y];
      [| destruct (Rlt_dec (orient (p c) (p a) z) 0) as [W | W]]].
    + now apply (walk_from _ M0 M _ a b c o G eq_refl X (Nat.lt_succ_diag_r _)).
    + refine (walk_from _ M0 M _ b c a o G1 _ Y (Nat.lt_succ_diag_r _)). unfold about in *. lra.
    + refine (walk_from _ M0 M _ c a b o G2 _ W (Nat.lt_succ_diag_r _)). unfold about in *. lra.
    + left. exists (Tri a b c o). split; [exact G |]. split; [reflexivity |]. unfold within. simpl. repeat split; lra. }
  destruct Found as [[f [K [Q I]]] | Q]; [left | now right]. exists f. split; [exact K |]. split; [lra | exact I].
Qed.
End Walk.

Definition face_vertex (T : list triangle) (H : list (nat * nat)) (v : nat) : Prop :=
  (exists t, In t T /\ ta t = v) \/ exists b, In (v, b) H \/ In (b, v) H.

(* A face of the skeleton of the representatives p. T: its triangles, each from all three corners; H: the hull edges of
   its ghost triangles, all sites on their left. Every side is legal, or the face continues beyond it, through the ghost
   too: there the sure vertices of the hull end it. *)
Definition rimmed (N : nat) (B : sites) (p : nat -> point) (T : list triangle) (H : list (nat * nat)) : Prop :=
  (forall a b c o, In (Tri a b c o) T ->
    In (Tri b c a o) T /\ ((a < N)%nat /\ (b < N)%nat /\ (c < N)%nat) /\
    (about o (p a) (p b) = 0 /\ about o (p a) (p c) = 0 /\ 0 < orient (p a) (p b) (p c)) /\
    (forall m, (m < N)%nat -> 0 <= about o (p a) (p m)) /\
    (legal N B a b \/ (exists l w, In (Tri b a l w) T) \/ In (a, b) H)) /\
  (forall a b, In (a, b) H ->
    ((a < N)%nat /\ (b < N)%nat /\ a <> b) /\
    (forall m, (m < N)%nat -> 0 <= orient (p a) (p b) (p m)) /\
    (exists m, (m < N)%nat /\ 0 < orient (p a) (p b) (p m)) /\
    (legal N B a b \/ exists k o, In (Tri a b k o) T) /\
    (sure_hull N B a \/ exists l, In (l, a) H) /\ (sure_hull N B b \/ exists l, In (b, l) H)).

Section Rim.
Variables (N : nat) (B : sites) (p : nat -> point) (T : list triangle) (H : list (nat * nat)).
Variable drawn : choice N B p.
Variable rim : rimmed N B p T H.
Variable distinct : forall v w, (v < N)%nat -> (w < N)%nat -> v <> w -> p v <> p w.

(* No point of the choice is in the open disc of a triangle or beyond a hull edge of the face. *)
Definition good (z : point) : Prop :=
  (forall t, In t T -> 0 <= about (centre t) (p (ta t)) z) /\
  forall e, In e H -> 0 <= orient (p (fst e)) (p (snd e)) z.

Lemma corner_of a b c o : In (Tri a b c o) T ->
  face_vertex T H a /\ face_vertex T H b /\ face_vertex T H c /\ In (Tri c a b o) T.
Proof.
  intros F. destruct rim as [R _]. destruct (R _ _ _ _ F) as [G _]. destruct (R _ _ _ _ G) as [K _].
  repeat split; [left; now exists (Tri a b c o) | left; now exists (Tri b c a o) | left;
    now exists (Tri c a b o) | exact K].
Qed.

Section Other.
(* A site that is not a vertex of the face, somewhere in its rectangle. *)
Variables (m : nat) (z : point).
Variable below : (m < N)%nat.
Variable foreign : ~ face_vertex T H m.
Variable place : inside z (B m).

(* A legal edge of the face: a circle through its ends has z outside, and the other vertices. *)
Lemma legal_disc a b : face_vertex T H a -> face_vertex T H b -> (a < N)%nat -> (b < N)%nat -> legal N B a b ->
  exists w, about w (p a) (p b) = 0 /\ 0 < about w (p a) z /\
    forall c, (c < N)%nat -> c <> a -> c <> b -> c <> m -> 0 < about w (p a) (p c).
Proof.
  intros Va Vb La Lb E.
  assert (Da : a <> m) by (intros ->; contradiction). assert (Db : b <> m) by (intros ->; contradiction).
  destruct (legal_sound N B a b (set_point p m z) La Lb E (set_choice N B p m z drawn place)) as [w [Eq Out]].
  rewrite !set_other in Eq by assumption. exists w. unfold about. split; [apply dist_eq in Eq; lra |]. split.
  - pose proof (Out m below (not_eq_sym Da) (not_eq_sym Db)) as X. rewrite set_same, set_other in X by assumption.
    apply dist_lt in X. lra.
  - intros c Lc Ca Cb Cm. pose proof (Out c Lc Ca Cb) as X. rewrite !set_other in X by assumption. apply dist_lt in X.
      lra.
Qed.

(* The point is at no vertex, either. *)
Variable away : forall v, face_vertex T H v -> z <> p v.

(* In a disc of the face: in one of its triangles, or beyond its hull. *)
Lemma in_disc : ~ good z -> (exists t, In t T /\ within p z t) \/ exists e,
  In e H /\ orient (p (fst e)) (p (snd e)) z < 0.
Proof.
  intros Bad. destruct (classic (exists e, In e H /\ orient (p (fst e)) (p (snd e)) z < 0)) as [Q | Q]; [now right |].
  destruct (classic (exists t, In t T /\ about (centre t) (p (ta t)) z < 0)) as [L | C].
  - destruct (walk p T z (fun a b => In (a, b) H /\ orient (p a) (p b) z < 0)) as [[t [F [_ I]]] | [a [b [F I]]]];
      [| | exact L | left; now exists t | right; now exists (a, b)].
    + intros a b c o F. destruct (proj1 rim _ _ _ _ F) as [G [_ [K _]]]. tauto.
    + intros a b c o F E Z. destruct (corner_of a b c o F) as [Va [Vb [Vc _]]].
      destruct (proj1 rim _ _ _ _ F) as [_ [[La [Lb Lc]] [[Eb [Ec D]] [Empty Side]]]].
      assert (Dab : p a <> p b) by (intros X; unfold orient in D; rewrite X in D; lra).
      destruct Side as [S | [[l [w G]] | S]].
      * exfalso. destruct (legal_disc a b Va Vb La Lb S) as [w [Wb [Wz Wo]]].
        destruct (pencil o w (p a) (p b) Dab Eb Wb) as [k K].
        assert (Cc : 0 < about w (p a) (p c)).
        { apply Wo; [exact Lc | | | intros ->; contradiction]; intros ->; unfold orient in D; lra. }
        rewrite K, Ec in Cc. rewrite K in Wz.
        assert (0 < k) by (apply (Rmult_lt_reg_r (orient (p a) (p b) (p c))); lra).
        assert (k * orient (p a) (p b) z < 0).
        { replace 0 with (k * 0) by ring. now apply Rmult_lt_compat_l. }
        lra.
      * left. exists l, w. split; [exact G |]. apply Empty. now destruct (proj1 rim _ _ _ _ G) as [_ [[_ [_ Ll]] _]].
      * right. now split.
  - exfalso. apply Bad. split.
    + intros t F. apply Rnot_lt_le. intros L. apply C. now exists t.
    + intros e F. apply Rnot_lt_le. intros L. apply Q. now exists e.
Qed.

(* ---- beyond the hull ---- *)

Lemma on_segment a b : face_vertex T H a -> face_vertex T H b -> (a < N)%nat -> (b < N)%nat ->
  legal N B a b \/ (exists k o, In (Tri a b k o) T) -> good z -> ~ between z (p a) (p b).
Proof.
  intros Va Vb La Lb S [G _] [t [Ht E]].
  assert (Mid : forall o, about o (p a) (p b) = 0 -> about o (p a) z <= 0).
  { intros o O. unfold about in *. rewrite E, dist2_mix. pose proof (dist2_nonneg (p a) (p b)).
    assert (0 <= t * (1 - t)) by (apply Rmult_le_pos; lra).
    assert (0 <= t * (1 - t) * dist2 (p a) (p b)) by (now apply Rmult_le_pos).
    replace (dist2 o (p b)) with (dist2 o (p a)) by lra. lra. }
  destruct S as [S | [k [o F]]].
  - destruct (legal_disc a b Va Vb La Lb S) as [w [Wb [Wz _]]]. specialize (Mid w Wb). lra.
  - destruct (proj1 rim _ _ _ _ F) as [_ [_ [[Eb [Ec D]] _]]]. destruct (corner_of a b k o F) as [_ [_ [Vk _]]].
    assert (about o (p a) z < 0); [| specialize (G _ F); simpl in G; lra].
    apply (in_triangle o (p a) (p b) (p k)); try assumption; try (now apply away); rewrite E;
      [replace (orient (p b) (p k) (mix t (p a) (p b))) with ((1 - t) * orient (p a) (p b) (p k)) |
       replace (orient (p k) (p a) (mix t (p a) (p b))) with (t * orient (p a) (p b) (p k)) |
       replace (orient (p a) (p b) (mix t (p a) (p b))) with 0]; try (unfold orient, mix; simpl; ring);
      try (apply Rmult_le_pos; lra); lra.
Qed.

(* Along the line of a hull edge, away from its segment, edge by edge; s: 1, or -1 for the way back. *)
Lemma walk_along s (L : list (nat * nat)) :
  (forall a b, In (a, b) L -> p a <> p b /\ 0 <= s * orient (p a) (p b) z /\
    (forall c, In (b, c) L -> 0 <= s * orient (p a) (p b) (p c)) /\
    (exists k, 0 < s * orient (p a) (p b) (p k) /\ forall c, In (b, c) L -> 0 <= s * orient (p b) (p c) (p k)) /\
    ~ between z (p a) (p b) /\ (~ between (p b) (p a) z \/ exists c, In (b, c) L)) ->
  forall n a b, In (a, b) L -> orient (p a) (p b) z = 0 -> between (p b) (p a) z ->
  forall v, 0 < dot v (p b) - dot v (p a) ->
  (length (filter (fun x => if Rlt_dec (dot v (p b)) (dot v (p x)) then true else false) (map snd L)) < n)%nat -> False.
Proof.
  intros HL. induction n as [| n IH]; intros a b F O Bt v V Few; [lia |].
  destruct (HL a b F) as [D [_ [Left [[k [Ok Lk]] [_ [Nb | [c G]]]]]]]; [contradiction |].
  destruct (HL b c G) as [D' [Oz [_ [_ [Nz _]]]]]. specialize (Left c G). specialize (Lk c G).
  destruct Bt as [t [Ht Eb]].
  assert (T1 : t <> 0) by (intros ->; rewrite mix_0 in Eb; now apply D).
  (* z and c on the line ab *)
  assert (Kz : t * orient (p b) (p c) z = - (1 - t) * orient (p a) (p b) (p c)).
  { rewrite Eb. unfold orient, mix. simpl. ring. }
  assert (T2 : t <> 1) by (intros ->; apply Nz; rewrite Eb, mix_1; exists 0; split; [lra | now rewrite mix_0]).
  assert (Zc : s * orient (p a) (p b) (p c) = 0).
  { assert (t * (s * orient (p b) (p c) z) = - (1 - t) * (s * orient (p a) (p b) (p c)))
      by (transitivity (s * (t * orient (p b) (p c) z)); [ring | rewrite Kz; ring]).
    assert (0 <= t * (s * orient (p b) (p c) z)) by (apply Rmult_le_pos; lra).
    assert (0 <= (1 - t) * (s * orient (p a) (p b) (p c))) by (apply Rmult_le_pos; lra).
    apply (Rmult_eq_reg_l (1 - t)); [| lra]. lra. }
  assert (S0 : s <> 0) by (intros ->; lra).
  assert (Oc : orient (p a) (p b) (p c) = 0) by (destruct (Rmult_integral _ _ Zc); [contradiction | assumption]).
  assert (Ob : orient (p b) (p c) z = 0).
  { apply (Rmult_eq_reg_l t); [| exact T1]. rewrite Kz, Oc. ring. }
  assert (U : (snd (p b) - snd (p a), - (fst (p b) - fst (p a))) <> (0, 0)).
  { intros X. apply D. pose proof (f_equal fst X) as X1. pose proof (f_equal snd X) as X2. simpl in X1, X2.
    rewrite (surjective_pairing (p a)), (surjective_pairing (p b)). f_equal; lra. }
  destruct (across _ (p b) (p c) U) as [g Hg]; [unfold orient in Oc; unfold dot; simpl; lra |]. simpl in Hg.
  assert (Gk : s * orient (p b) (p c) (p k) = g * (s * orient (p a) (p b) (p k)))
    by (rewrite Hg; unfold orient; simpl; ring).
  assert (G0 : 0 < g).
  { assert (g <> 0).
    { intros ->. apply D'. rewrite Hg. rewrite (surjective_pairing (p b)) at 1. f_equal; ring. }
    assert (0 <= g); [| lra]. apply Rnot_lt_le. intros X. assert (g * (s * orient (p a) (p b) (p k)) < 0) by nra. lra. }
  assert (Vc : dot v (p c) - dot v (p b) = g * (dot v (p b) - dot v (p a))) by (rewrite Hg; unfold dot; simpl; ring).
  assert (V' : 0 < dot v (p c) - dot v (p b)) by (rewrite Vc; now apply Rmult_lt_0_compat).
  destruct (one_between (p b) (p c) z Ob) as [X | [X | X]].
  - (* b between c and z *)
    destruct X as [r [Hr Er]].
    assert (Zv : dot v z - dot v (p b) = (1 - t) / t * (dot v (p b) - dot v (p a))).
    { apply (Rmult_eq_reg_l t); [| exact T1]. replace (t * ((1 - t) / t * (dot v (p b) - dot v (p a)))) with
        ((1 - t) * (dot v (p b) - dot v (p a))) by (field; exact T1).
      replace (dot v (p b)) with ((1 - t) * dot v (p a) + t * dot v z)
        by (rewrite Eb; unfold dot, mix; simpl; ring). ring. }
    assert (0 < (1 - t) / t * (dot v (p b) - dot v (p a))).
    { apply Rmult_lt_0_compat; [apply Rdiv_lt_0_compat; lra | lra]. }
    assert (Q : dot v (p b) = (1 - r) * dot v (p c) + r * dot v z) by (rewrite Er; unfold dot, mix; simpl; ring).
    assert (0 <= (1 - r) * (dot v (p c) - dot v (p b))) by (apply Rmult_le_pos; lra).
    assert (0 <= r * (dot v z - dot v (p b))) by (apply Rmult_le_pos; lra).
    destruct (Req_dec r 0) as [-> | R0]; [lra |].
    assert (0 < r * (dot v z - dot v (p b))) by (apply Rmult_lt_0_compat; lra). lra.
  - refine (IH b c G Ob X v V' _). eapply Nat.lt_le_trans; [| apply Nat.lt_succ_r; exact Few].
    apply fewer with (x := c).
    + intros y. destruct (Rlt_dec (dot v (p c)) (dot v (p y))) as [Y | Y]; [| discriminate]. intros _.
      destruct (Rlt_dec (dot v (p b)) (dot v (p y))) as [_ | C]; [reflexivity | lra].
    + change c with (snd (b, c)). now apply in_map.
    + destruct (Rlt_dec (dot v (p b)) (dot v (p c))) as [_ | C]; [reflexivity | lra].
    + destruct (Rlt_dec (dot v (p c)) (dot v (p c))) as [C | _]; [lra | reflexivity].
  - now apply Nz.
Qed.

Lemma between_swap x a b : between x a b -> between x b a.
Proof. intros [t [S E]]. exists (1 - t). split; [lra |]. rewrite <- mix_swap. exact E. Qed.

Lemma ends_at a b : face_vertex T H a -> face_vertex T H b -> (a < N)%nat -> (b < N)%nat -> a <> b ->
  sure_hull N B b -> ~ between (p b) (p a) z.
Proof.
  intros Va Vb La Lb D S.
  assert (Da : a <> m) by (intros ->; contradiction). assert (Db : b <> m) by (intros ->; contradiction).
  pose proof (sure_hull_not_between N B (set_point p m z) b a m Lb La below D (not_eq_sym Db)
    (set_choice N B p m z drawn place) S) as K.
  now rewrite set_same, !set_other in K by assumption.
Qed.

(* A good place is not on the line of a hull edge of the face. *)
Lemma off_line a b : In (a, b) H -> good z -> orient (p a) (p b) z <> 0.
Proof.
  intros F G O.
  assert (Vert : forall x y, In (x, y) H -> face_vertex T H x /\ face_vertex T H y)
    by (intros x y K; split; right; eexists; [left | right]; exact K).
  assert (Free : forall x y, In (x, y) H -> ~ between z (p x) (p y)).
  { intros x y K. destruct (proj2 rim _ _ K) as [[Lx [Ly D]] [_ [_ [S _]]]]. destruct (Vert x y K).
    now apply on_segment. }
  assert (Away : forall x y, In (x, y) H -> p x <> p y).
  { intros x y K. destruct (proj2 rim _ _ K) as [[Lx [Ly D]] _]. now apply distinct. }
  destruct (Vert a b F) as [Va Vb]. pose proof (Away a b F) as D.
  destruct (one_between _ _ _ O) as [X | [X | X]]; [| | now apply (Free a b F)].
  - (* back *)
    refine (walk_along (-1) (map (fun e => (snd e, fst e)) H) _ _ b a _ _ X
      (fst (p a) - fst (p b), snd (p a) - snd (p b)) _ (Nat.lt_succ_diag_r _)).
    + intros y x K. apply in_map_iff in K as [[x' y'] [E K]]. simpl in E. injection E as -> ->.
      destruct (proj2 rim _ _ K) as [[Lx [Ly Dxy]] [Left [[k [Lk Ok]] [S [Sx _]]]]]. destruct (Vert x y K) as [Vx Vy].
      split; [now apply not_eq_sym, Away |]. split; [pose proof (proj2 G _ K) as Q; simpl in Q; unfold orient in *;
        lra |].
      split; [| split; [| split]].
      * intros c C. apply in_map_iff in C as [[c' x'] [E C]]. simpl in E. injection E as -> ->.
        destruct (proj2 rim _ _ C) as [[Lc _] _]. specialize (Left c Lc). unfold orient in *. lra.
      * exists k. split; [unfold orient in *; lra |]. intros c C. apply in_map_iff in C as [[c' x'] [E C]].
        simpl in E. injection E as -> ->. pose proof (proj1 (proj2 (proj2 rim _ _ C)) k Lk). unfold orient in *. lra.
      * intros Q. apply (Free x y K). now apply between_swap.
      * destruct Sx as [Q | [l C]]; [left; apply (ends_at y x); auto using not_eq_sym | right].
        exists l. apply in_map_iff. now exists (l, x).
    + apply in_map_iff. now exists (a, b).
    + unfold orient in *. lra.
    + assert (Q : 0 < dist2 (p a) (p b)) by (rewrite <- dist_sq; pose proof (dist_pos _ _ D); nra).
      unfold dot, dist2 in *. simpl. lra.
  - refine (walk_along 1 H _ _ a b F O X (fst (p b) - fst (p a), snd (p b) - snd (p a)) _ (Nat.lt_succ_diag_r _)).
    + intros x y K. destruct (proj2 rim _ _ K) as [[Lx [Ly Dxy]] [Left [[k [Lk Ok]] [S [_ Sy]]]]].
      destruct (Vert x y K) as [Vx Vy]. split; [now apply Away |].
      split; [pose proof (proj2 G _ K) as Q; simpl in Q; lra |]. split; [| split; [| split]].
      * intros c C. destruct (proj2 rim _ _ C) as [[_ [Lc _]] _]. specialize (Left c Lc). lra.
      * exists k. split; [lra |]. intros c C. pose proof (proj1 (proj2 (proj2 rim _ _ C)) k Lk). lra.
      * now apply Free.
      * destruct Sy as [Q | [l C]]; [left; now apply (ends_at x y) | right; now exists l].
    + assert (Q : 0 < dist2 (p a) (p b)) by (rewrite <- dist_sq; pose proof (dist_pos _ _ D); nra).
      unfold dot, dist2 in *. simpl. lra.
Qed.
End Other.

Lemma not_within z t : (forall v, face_vertex T H v -> z <> p v) -> good z -> In t T -> ~ within p z t.
Proof.
  intros Aw G F [A [C D]]. destruct t as [a b c o]. simpl in *.
  destruct (corner_of a b c o F) as [Va [Vb [Vc _]]]. destruct (proj1 rim _ _ _ _ F) as [_ [_ [[Eb [Ec O]] _]]].
  assert (about o (p a) z < 0); [| pose proof (proj1 G _ F) as Q; simpl in Q; lra].
  apply (in_triangle o (p a) (p b) (p c)); try assumption; now apply Aw.
Qed.

(* A vertex v that a point reaches has no legal edge: the triangles at it, and the part beyond the hull, surround it. *)
Section Reached.
Variables (m v : nat) (y : point).
Variable below : (m < N)%nat.
Variable foreign : ~ face_vertex T H m.
Variable place : inside (p v) (B m).
Variable vertex : face_vertex T H v.
Variable beside : y <> p v.
Variable fine : good y.
Variable close : forall a b o, In (Tri v a b o) T -> 0 < orient (p a) (p b) y.

Lemma no_legal a : face_vertex T H a -> (a < N)%nat -> (v < N)%nat -> ~ legal N B v a /\ ~ legal N B a v.
Proof.
  intros Va La Lv. split; intros E.
  - destruct (legal_disc m (p v) below foreign place v a vertex Va Lv La E) as [w [_ [X _]]]. unfold about in X. lra.
  - destruct (legal_disc m (p v) below foreign place a v Va vertex La Lv E) as [w [X [Y _]]]. lra.
Qed.

Lemma clockwise a b o : In (Tri v a b o) T -> (exists l w, In (Tri v l a w) T) \/ In (v, a) H.
Proof.
  intros F. destruct (corner_of v a b o F) as [_ [Va _]].
  destruct (proj1 rim _ _ _ _ F) as [_ [[Lv [La _]] [_ [_ [S | [[l [w G]] | S]]]]]].
  - exfalso. now apply (proj1 (no_legal a Va La Lv)).
  - left. exists l, w. now apply (proj1 rim _ _ _ _ G).
  - now right.
Qed.

Lemma counterclockwise a b o : In (Tri v a b o) T -> (exists l w, In (Tri v b l w) T) \/ In (b, v) H.
Proof.
  intros F. destruct (corner_of v a b o F) as [_ [_ [Vb G]]].
  destruct (proj1 rim _ _ _ _ G) as [_ [[Lb [Lv _]] [_ [_ [S | [S | S]]]]]].
  - exfalso. now apply (proj2 (no_legal b Vb Lb Lv)).
  - now left.
  - now right.
Qed.

Definition cross (a : nat) : R := orient (p v) (p a) y.
Definition ahead (a : nat) : R :=
  (fst (p a) - fst (p v)) * (fst y - fst (p v)) + (snd (p a) - snd (p v)) * (snd y - snd (p v)).

Lemma turned a b : orient (p v) (p a) (p b) * dist2 y (p v) = cross a * ahead b - ahead a * cross b.
Proof. unfold orient, cross, ahead, dist2, orient. ring. Qed.

Lemma far : 0 < dist2 y (p v).
Proof. rewrite <- dist_sq. pose proof (dist_pos y (p v) beside). nra. Qed.

Lemma not_in_cone a b o : In (Tri v a b o) T -> 0 <= cross a -> cross b <= 0 -> False.
Proof.
  intros F A C. pose proof (close a b o F) as Z. destruct (proj1 rim _ _ _ _ F) as [_ [_ [[Eb [Ec O]] _]]].
  assert (about o (p v) y < 0); [| pose proof (proj1 fine _ F) as Q; simpl in Q; lra].
  apply (in_triangle o (p v) (p a) (p b)); try assumption; try lra.
  - replace (orient (p b) (p v) y) with (- cross b) by (unfold cross, orient; ring). lra.
  - intros X. rewrite X in Z. unfold orient in Z. lra.
  - intros X. rewrite X in Z. unfold orient in Z. lra.
Qed.

Lemma not_on_ray a b o : In (Tri v a b o) T -> cross a = 0 -> ahead a <= 0.
Proof.
  intros F A. apply Rnot_lt_le. intros P. destruct (proj1 rim _ _ _ _ F) as [_ [_ [[_ [_ O]] _]]].
  pose proof (turned a b) as E. pose proof far as Y. apply (not_in_cone a b o F); [lra |].
  assert (0 < orient (p v) (p a) (p b) * dist2 y (p v)) by (now apply Rmult_lt_0_compat).
  apply Rnot_lt_le. intros Q. assert (0 < ahead a * cross b) by (now apply Rmult_lt_0_compat). rewrite A in E. lra.
Qed.

Lemma some_triangle : exists a b o, In (Tri v a b o) T.
Proof.
  destruct vertex as [[[a b c o] [F E]] | [b [F | F]]].
  - simpl in E. subst a. now exists b, c, o.
  - destruct (proj2 rim _ _ F) as [[Lv [Lb _]] [_ [_ [[S | [k [o G]]] _]]]]; [| now exists b, k, o].
    exfalso. apply (proj1 (no_legal b ltac:(right; exists v; now right) Lb Lv) S).
  - destruct (proj2 rim _ _ F) as [[Lb [Lv _]] [_ [_ [[S | [k [o G]]] _]]]].
    + exfalso. apply (proj2 (no_legal b ltac:(right; exists v; now left) Lb Lv) S).
    + exists k, b, o. now apply (proj1 rim _ _ _ _ G).
Qed.

Definition at_v (P : nat -> Prop) (t : triangle) : Prop := ta t = v /\ P (tb t).

Lemma some_right : exists t, In t T /\ at_v (fun a => 0 < cross a) t.
Proof.
  apply NNPP. intros None.
  assert (All : forall a b o, In (Tri v a b o) T -> cross a <= 0).
  { intros a b o F. apply Rnot_lt_le. intros Q. apply None. exists (Tri v a b o). now repeat split. }
  assert (Left : exists t, In t T /\ at_v (fun a => cross a < 0) t).
  { destruct some_triangle as [a [b [o F]]]. destruct (Rlt_dec (cross a) 0) as [Q | Q].
    { exists (Tri v a b o). now repeat split. }
    assert (A : cross a = 0) by (specialize (All a b o F); lra).
    destruct (proj1 rim _ _ _ _ F) as [_ [_ [[_ [_ O]] _]]]. pose proof (not_on_ray a b o F A) as P.
    pose proof (turned a b) as E. pose proof far as Y. rewrite A in E.
    assert (0 < orient (p v) (p a) (p b) * dist2 y (p v)) by (now apply Rmult_lt_0_compat).
    assert (C : 0 < cross b) by (apply Rnot_le_lt; intros C;
      assert (0 <= - ahead a * - cross b) by (apply Rmult_le_pos; lra); nra).
    destruct (counterclockwise a b o F) as [[l [w G]] | G].
    - specialize (All b l w G). lra.
    - pose proof (proj2 fine _ G) as K. simpl in K. unfold cross, orient in *. lra. }
  destruct (least (fun t => ahead (tb t) / cross (tb t)) _ T Left) as [[v' a b o] [F [[E A] M]]].
  simpl in E, A. subst v'. destruct (clockwise a b o F) as [[l [w G]] | G].
  - destruct (proj1 rim _ _ _ _ G) as [_ [_ [[_ [_ O]] _]]]. pose proof (turned l a) as E. pose proof far as Y.
    assert (Pr : 0 < orient (p v) (p l) (p a) * dist2 y (p v)) by (now apply Rmult_lt_0_compat). rewrite E in Pr.
    pose proof (All l a w G) as L. destruct (Req_dec (cross l) 0) as [Z | Z].
    + rewrite Z in Pr. pose proof (not_on_ray l a w G Z). assert (0 <= - ahead l * - cross a) by (apply Rmult_le_pos;
      lra). lra.
    + specialize (M (Tri v l a w) G ltac:(split; simpl; [reflexivity | lra])). simpl in M.
      assert (K : 0 < cross l * cross a) by nra.
      assert (D : ahead a / cross a - ahead l / cross l = (cross l * ahead a - ahead l * cross a) / (cross l * cross a))
        by (field; split; lra).
      assert (0 < (cross l * ahead a - ahead l * cross a) / (cross l * cross a)) by (now apply Rdiv_lt_0_compat). lra.
  - pose proof (proj2 fine _ G) as K. simpl in K. unfold cross in A. lra.
Qed.

Lemma surrounded : False.
Proof.
  destruct (least (fun t => - (ahead (tb t) / cross (tb t))) _ T some_right) as [[v' a b o] [F [[E A] M]]].
  simpl in E, A. subst v'. destruct (Rle_dec (cross b) 0) as [C | C]; [apply (not_in_cone a b o F); lra |].
  destruct (counterclockwise a b o F) as [[l [w G]] | G].
  - destruct (proj1 rim _ _ _ _ F) as [_ [_ [[_ [_ O]] _]]]. pose proof (turned a b) as E. pose proof far as Y.
    assert (Pr : 0 < orient (p v) (p a) (p b) * dist2 y (p v)) by (now apply Rmult_lt_0_compat). rewrite E in Pr.
    specialize (M (Tri v b l w) G ltac:(split; simpl; [reflexivity | lra])). simpl in M.
    assert (K : 0 < cross a * cross b) by (apply Rmult_lt_0_compat; lra).
    assert (D : ahead b / cross b - ahead a / cross a = (cross a * ahead b - ahead a * cross b) / (cross a * cross b))
      by (field; split; lra).
    assert (0 < (cross a * ahead b - ahead a * cross b) / (cross a * cross b)) by (now apply Rdiv_lt_0_compat). lra.
  - pose proof (proj2 fine _ G) as K. simpl in K. unfold cross, orient in *. lra.
Qed.
End Reached.

(* ---- from its place in the skeleton to another ---- *)

Lemma about_continuous o a y z : continuity (fun t => about o a (mix t y z)).
Proof. unfold about, dist2, mix. simpl. reg. Qed.

Lemma orient_continuous a b y z : continuity (fun t => orient a b (mix t y z)).
Proof. unfold orient, mix. simpl. reg. Qed.

Lemma distance_continuous v y z : continuity (fun t => dist2 (mix t y z) v).
Proof. unfold dist2, mix. simpl. reg. Qed.

Section Motion.
Variables (m : nat) (z : point).
Variable below : (m < N)%nat.
Variable foreign : ~ face_vertex T H m.
Variable place : inside z (B m).
Let x t := mix t (p m) z.
Let sound t := good (x t) /\ forall v, face_vertex T H v -> x t <> p v.

Lemma on_the_way t : 0 <= t <= 1 -> inside (x t) (B m).
Proof. intros S. apply inside_convex; [exact S | apply drawn, below | exact place]. Qed.

Lemma stays_away t : (forall v, face_vertex T H v -> x t <> p v) ->
  near t (fun s => forall v, face_vertex T H v -> x s <> p v).
Proof.
  intros A.
  assert (K : near t (fun s => forall v, In v (map ta T ++ map fst H ++ map snd H) -> 0 < dist2 (x s) (p v))).
  { apply near_list. intros v V. apply near_positive; [apply distance_continuous |].
    assert (x t <> p v).
    { apply A. apply in_app_or in V as [V | V]; [| apply in_app_or in V as [V | V]]; apply in_map_iff in V as [f [E F]].
      - left. now exists f.
      - right. exists (snd f). left. rewrite <- E. now destruct f.
      - right. exists (fst f). right. rewrite <- E. now destruct f. }
    rewrite <- dist_sq. pose proof (dist_pos (x t) (p v) ltac:(assumption)). nra. }
  revert K. apply near_weaken. intros s S v V E.
  assert (Q : 0 < dist2 (x s) (p v)).
  { apply S. apply in_or_app. destruct V as [[f [F <-]] | [b [F | F]]]; [left; now apply in_map | right | right];
      apply in_or_app; [left | right]; apply in_map_iff; [now exists (v, b) | now exists (b, v)]. }
  rewrite E in Q. unfold dist2 in Q. lra.
Qed.

Lemma stays_sound t : 0 <= t <= 1 -> sound t -> near t (fun s => 0 <= s <= 1 -> sound s).
Proof.
  intros S [G A].
  assert (K1 : near t (fun s => forall f, In f T -> ~ within p (x s) f)).
  { apply near_list. intros f F. pose proof (not_within _ f A G F) as W. unfold within in *.
    destruct (Rlt_dec (orient (p (ta f)) (p (tb f)) (x t)) 0) as [X | X];
      [| destruct (Rlt_dec (orient (p (tb f)) (p (tc f)) (x t)) 0) as [Y | Y]].
    - generalize (near_negative _ t (orient_continuous (p (ta f)) (p (tb f)) (p m) z) X). apply near_weaken.
      intros s X' [Q _]. unfold x in Q. lra.
    - generalize (near_negative _ t (orient_continuous (p (tb f)) (p (tc f)) (p m) z) Y). apply near_weaken.
      intros s Y' [_ [Q _]]. unfold x in Q. lra.
    - assert (Z : orient (p (tc f)) (p (ta f)) (x t) < 0) by (apply Rnot_le_lt; intros Q; apply W; lra).
      generalize (near_negative _ t (orient_continuous (p (tc f)) (p (ta f)) (p m) z) Z). apply near_weaken.
      intros s Z' [_ [_ Q]]. unfold x in Q. lra. }
  assert (K2 : near t (fun s => forall e, In e H -> 0 < orient (p (fst e)) (p (snd e)) (x s))).
  { apply near_list. intros [a b] F. simpl. apply near_positive; [apply orient_continuous |].
    pose proof (off_line m _ below foreign (on_the_way t S) A a b F G). pose proof (proj2 G _ F) as Q. simpl in Q.
    unfold x in *. lra. }
  generalize (near_and _ _ _ (stays_away t A) (near_and _ _ _ K1 K2)). apply near_weaken. intros s [A' [W O]] S'.
  split; [| exact A']. apply NNPP. intros Bad.
  destruct (in_disc m _ below foreign (on_the_way s S') Bad) as [[f [F Q]] | [f [F Q]]]; [now apply (W f F) |].
  specialize (O f F). lra.
Qed.

Lemma stays_bad t : 0 <= t <= 1 -> ~ sound t -> near t (fun s => 0 <= s <= 1 -> ~ sound s).
Proof.
  intros S Bad. destruct (classic (good (x t))) as [G | NG].
  - assert (V : exists v, face_vertex T H v /\ x t = p v).
    { apply NNPP. intros C. apply Bad. split; [exact G |]. intros v V E. apply C. now exists v. }
    destruct V as [v [V E]].
    assert (K : near t (fun s => forall f, In f T -> ta f = v -> 0 < orient (p (tb f)) (p (tc f)) (x s))).
    { apply near_list. intros [a b c o] F. simpl. destruct (classic (a = v)) as [-> | D].
      - assert (Q : 0 < orient (p b) (p c) (mix t (p m) z)).
        { destruct (proj1 rim _ _ _ _ F) as [_ [_ [[_ [_ O]] _]]]. unfold x in E. rewrite E. unfold orient in *. lra. }
        generalize (near_positive _ t (orient_continuous (p b) (p c) (p m) z) Q). apply near_weaken. auto.
      - exists 1. split; [lra |]. intros. now elim D. }
    revert K. apply near_weaken. intros s K _ [G' A'].
    apply (surrounded m v (x s)); auto.
    + rewrite <- E. now apply on_the_way.
    + intros a b o F. exact (K _ F eq_refl).
  - destruct (classic (exists f, In f T /\ about (centre f) (p (ta f)) (x t) < 0)) as [[f [F Q]] | C1].
    + generalize (near_negative _ t (about_continuous (centre f) (p (ta f)) (p m) z) Q). apply near_weaken.
      intros s K _ [[G _] _]. specialize (G f F). unfold x in G. lra.
    + destruct (classic (exists e, In e H /\ orient (p (fst e)) (p (snd e)) (x t) < 0)) as [[e [F Q]] | C2].
      * generalize (near_negative _ t (orient_continuous (p (fst e)) (p (snd e)) (p m) z) Q). apply near_weaken.
        intros s K _ [[_ G] _]. specialize (G e F). unfold x in G. lra.
      * exfalso. apply NG. split.
        -- intros f F. apply Rnot_lt_le. intros Q. apply C1. now exists f.
        -- intros e F. apply Rnot_lt_le. intros Q. apply C2. now exists e.
Qed.
End Motion.

Lemma starts_good m : (m < N)%nat -> good (p m).
Proof.
  intros L. split.
  - intros [a b c o] F. destruct (proj1 rim _ _ _ _ F) as [_ [_ [_ [E _]]]]. simpl. now apply E.
  - intros [a b] F. simpl. now apply (proj2 rim _ _ F).
Qed.

Lemma vertex_below v : face_vertex T H v -> (v < N)%nat.
Proof.
  intros [[[a b c o] [F <-]] | [b [F | F]]]; [now apply (proj1 rim _ _ _ _ F) | |]; now apply (proj2 rim _ _ F).
Qed.

(* Every other site is always outside: of the open discs of the face's triangles, and on the inner side of its hull; and
   at none of its vertices. *)
Theorem rim_keeps_out m z : (m < N)%nat -> ~ face_vertex T H m -> inside z (B m) ->
  good z /\ forall v, face_vertex T H v -> z <> p v.
Proof.
  intros L Fo I. rewrite <- (mix_1 (p m) z).
  apply (open_closed (fun t => good (mix t (p m) z) /\ forall v, face_vertex T H v -> mix t (p m) z <> p v)).
  - rewrite mix_0. split; [now apply starts_good |]. intros v V. apply distinct; [exact L | now apply vertex_below |].
    intros ->. contradiction.
  - intros t S G. destruct (stays_sound m z L Fo I t S G) as [e K]. now exists e.
  - intros t S G. destruct (stays_bad m z L Fo I t S G) as [e K]. now exists e.
Qed.
End Rim.
